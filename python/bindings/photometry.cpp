#include "python/bindings/photometry.h"

#include <pybind11/eigen.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "io/light/photometric_file.h"
#include "python/bindings/arrays.h"
#include "python/bindings/work.h"
#include "radiosity/scene/photometry.h"

namespace python {
namespace {

namespace py = pybind11;
using namespace radiosity;

Photometry read_photometry(const std::filesystem::path& path, const py::object& report) {
  Photometry photometry;
  run_work({.report = report}, [&](const study::StudyEvents& events) {
    photometry = io::read_photometric_file(path, events.progress);
    for (const std::string& warning : photometry.warnings) events.warn(warning);
  });
  return photometry;
}

/// Of directions that were checked, n x 3.
Array<double> intensities(const Photometry& photometry, const Array<double>& directions) {
  std::vector<double> values;
  for (const Vec3& direction : points_of(directions)) {
    values.push_back(intensity(photometry.web, direction));
  }
  return owned_array(std::move(values));
}

const char* type_name(PhotometricWeb::Type type) {
  return type == PhotometricWeb::Type::c ? "C" : type == PhotometricWeb::Type::b ? "B" : "A";
}

}  // namespace

void bind_photometry(py::module_& module) {
  py::class_<Photometry>(module, "Photometry")
      .def_readonly("format", &Photometry::format)
      .def_readonly("name", &Photometry::name)
      .def_readonly("maker", &Photometry::maker)
      .def_readonly("lamp_flux", &Photometry::lamp_flux)
      .def_readonly("power", &Photometry::power)
      .def_readonly("along_c0", &Photometry::along_c0)
      .def_readonly("along_c90", &Photometry::along_c90)
      .def_property_readonly("type",
                             [](const Photometry& self) { return type_name(self.web.type); })
      .def_property_readonly("flux", [](const Photometry& self) { return flux(self.web); })
      .def_property_readonly(
          "peak", [](const Photometry& self) { return peak_intensity(self.web).intensity; })
      .def("intensity", &intensities)
      .def("spread", [](const Photometry& self, double plane, double share) {
        return spread(self.web, plane, share);
      });
  module.def("read_photometry", &read_photometry);
}

}  // namespace python
