#include "python/bindings/study_options.h"

#include <pybind11/stl.h>

#include <optional>
#include <string>

#include "radiosity/base/error.h"

namespace python {
namespace {

namespace py = pybind11;
using radiosity::Closed;
using radiosity::TransportKind;
using study::StudyOptions;

void set_closed(StudyOptions& options, std::optional<bool> closed) {
  options.closed = !closed ? Closed::automatic : *closed ? Closed::yes : Closed::no;
}

void set_transport(StudyOptions& options, const std::string& kind) {
  if (kind == "dense") {
    options.transport = TransportKind::dense;
  } else if (kind == "compressed") {
    options.transport = TransportKind::compressed;
  } else if (kind == "auto") {
    options.transport = TransportKind::automatic;
  } else {
    throw radiosity::SolveError("found transport '" + kind +
                                "', expected 'auto', 'dense' or 'compressed'");
  }
}

void set_method(StudyOptions& options, const std::string& name) {
  const auto method = radiosity::method_named(name);
  if (!method) {
    std::string known;
    for (const auto each : radiosity::all_methods()) {
      known += (known.empty() ? "'" : ", '") + std::string(radiosity::method_name(each)) + "'";
    }
    throw radiosity::SolveError("found method '" + name + "', expected one of " + known);
  }
  options.method = *method;
}

}  // namespace

void bind_study_options(py::module_& module) {
  py::class_<StudyOptions>(module, "StudyOptions")
      .def(py::init<>())
      .def_property("max_edge", nullptr,
                    [](StudyOptions& o, std::optional<double> v) { o.patches.max_edge = v; })
      .def_property("patches", nullptr,
                    [](StudyOptions& o, std::optional<long> v) { o.patches.n_patches = v; })
      .def_property("as_is", nullptr, [](StudyOptions& o, bool v) { o.patches.as_is = v; })
      .def_property("adaptive", nullptr, [](StudyOptions& o, bool v) { o.patches.adaptive = v; })
      .def_readwrite("tolerance", &StudyOptions::tolerance)
      .def_readwrite("factor_tolerance", &StudyOptions::factor_tolerance)
      .def_readwrite("seed", &StudyOptions::seed)
      .def_readwrite("memory", &StudyOptions::memory)
      .def_property("closed", nullptr, &set_closed)
      .def_property("transport", nullptr, &set_transport)
      .def_property("method", nullptr, &set_method);
}

}  // namespace python
