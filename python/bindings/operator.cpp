#include "python/bindings/operator.h"

#include <pybind11/eigen.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <utility>
#include <vector>

#include "io/result/operator_file.h"
#include "meshing/patches/patches.h"
#include "python/bindings/arrays.h"
#include "python/bindings/work.h"
#include "radiosity/base/parallel.h"
#include "radiosity/operator/surface_factors.h"
#include "radiosity/scene/scene.h"
#include "radiosity/visibility/incident_light.h"

namespace python {
namespace {

namespace py = pybind11;
using namespace radiosity;

/// Rows that are taken at once, before they are added to the matrix.
constexpr Index kStrip = 64;

/// Compressed rows, as scipy.sparse.csr_matrix takes them.
struct Rows {
  std::vector<double> data;
  std::vector<double> error;
  std::vector<std::int32_t> indices;
  std::vector<std::int64_t> indptr{0};

  void reserve(std::size_t n) {
    data.reserve(n);
    error.reserve(n);
    indices.reserve(n);
  }
  void add(const Eigen::VectorXd& row, const Eigen::VectorXd& row_error) {
    for (Index j = 0; j < row.size(); ++j) {
      if (row[j] == 0 && row_error[j] == 0) continue;
      data.push_back(row[j]);
      error.push_back(row_error[j]);
      indices.push_back(static_cast<std::int32_t>(j));
    }
    indptr.push_back(static_cast<std::int64_t>(data.size()));
  }
};

Rows rows_of_operator(const Operator& factors, const study::StudyEvents& events) {
  const FactorRows& from = rows_of(*factors.transport);
  const AssemblyReport& report = factors.transport->report();
  const Index n = factors.transport->size();
  Rows rows;
  // Those between covered parts are counted with others, and few.
  rows.reserve(2 * static_cast<std::size_t>(report.visible + report.undecided + report.known));
  std::vector<std::array<Eigen::VectorXd, 2>> strip(kStrip);
  for (Index first = 0; first < n; first += kStrip) {
    const Index count = std::min(kStrip, n - first);
    parallel_for(count, [&](std::ptrdiff_t k) {
      events.progress.check();
      strip[k] = {from.row(first + k), from.row_error(first + k)};
    });
    for (Index k = 0; k < count; ++k) rows.add(strip[k][0], strip[k][1]);
    if (events.progress.report) {
      events.progress.report("rows", static_cast<double>(first + count), static_cast<double>(n),
                             "rows");
    }
  }
  return rows;
}

py::tuple csr(const Operator& factors, const py::object& report) {
  Rows rows;
  run_work({.report = report},
           [&](const study::StudyEvents& events) { rows = rows_of_operator(factors, events); });
  return py::make_tuple(owned_array(std::move(rows.data)), owned_array(std::move(rows.error)),
                        owned_array(std::move(rows.indices)), owned_array(std::move(rows.indptr)));
}

void save(const Operator& factors, const std::filesystem::path& path, const py::object& report) {
  run_work({.report = report}, [&](const study::StudyEvents& events) {
    io::write_operator(path, *factors.mesh, *factors.transport,
                       {.tolerance = factors.tolerance, .geometry = factors.geometry},
                       events.progress);
  });
}

Operator load(const std::filesystem::path& path, std::size_t memory, const py::object& report) {
  Operator result;
  run_work({.report = report}, [&](const study::StudyEvents& events) {
    io::StoredOperator stored = io::read_operator(path, events.progress, memory);
    result = {std::make_shared<const PatchMesh>(std::move(stored.mesh)),
              std::move(stored.transport), stored.tolerance, std::move(stored.geometry)};
  });
  return result;
}

py::dict report_of(const Operator& factors) {
  const AssemblyReport& report = factors.transport->report();
  py::dict result;
  result["seconds"] = report.seconds;
  result["closed"] = report.closed;
  result["open_rows"] = report.open_rows;
  result["closure_mean"] = report.closure_mean;
  result["closure_max"] = report.closure_max;
  result["facing"] = report.facing;
  result["visible"] = report.visible;
  result["hidden"] = report.hidden;
  result["undecided"] = report.undecided;
  result["partial"] = report.partial;
  result["rays"] = report.rays;
  if (report.compression) {
    py::dict compression;
    compression["verified_error"] = report.compression->verified_error;
    compression["estimated_error"] = report.compression->estimated_error;
    compression["rows"] = report.compression->n_rows;
    compression["rounds"] = report.compression->n_rounds;
    compression["numbers_per_patch"] = report.compression->coefficients;
    compression["entries_per_patch"] = report.compression->entries;
    result["compression"] = compression;
  }
  return result;
}

Array<std::int32_t> corners_array(const PatchMesh& mesh) {
  Array<std::int32_t> result({static_cast<py::ssize_t>(mesh.size()), py::ssize_t{4}});
  std::copy_n(mesh.corners.empty() ? nullptr : mesh.corners[0].data(), 4 * mesh.corners.size(),
              result.mutable_data());
  return result;
}

void bind_patches(py::module_& module) {
  py::class_<PatchMesh, std::shared_ptr<PatchMesh>>(module, "Patches")
      .def("__len__", &PatchMesh::size)
      .def_property_readonly("vertices",
                             [](const PatchMesh& mesh) { return points_array(mesh.vertices); })
      .def_property_readonly("corners", &corners_array)
      .def_property_readonly("surface",
                             [](const PatchMesh& mesh) { return copied_array(mesh.surface); })
      .def_property_readonly("polygon",
                             [](const PatchMesh& mesh) { return copied_array(mesh.polygon); })
      .def_property_readonly("twin", [](const PatchMesh& mesh) { return copied_array(mesh.twin); })
      .def_property_readonly("area", [](const PatchMesh& mesh) { return copied_array(mesh.area); })
      .def_property_readonly("normal",
                             [](const PatchMesh& mesh) { return points_array(mesh.normal); })
      .def_property_readonly("centroid",
                             [](const PatchMesh& mesh) { return points_array(mesh.centroid); })
      .def_readonly("surface_names", &PatchMesh::surface_names)
      .def("lit_shares", [](const PatchMesh& mesh, const Eigen::VectorXd& direction) {
        return unlocked([&] { return lit_shares(mesh, Vec3(direction.stableNormalized())); });
      });
}

}  // namespace

void bind_operator(py::module_& module) {
  bind_patches(module);
  py::class_<Operator>(module, "Operator")
      .def_property_readonly("size", [](const Operator& f) { return f.transport->size(); })
      .def_property_readonly(
          "patches", [](const Operator& f) { return std::const_pointer_cast<PatchMesh>(f.mesh); })
      .def_readonly("tolerance", &Operator::tolerance)
      .def_property_readonly("bytes", [](const Operator& f) { return f.transport->bytes(); })
      .def_property_readonly("error", [](const Operator& f) { return f.transport->error(); })
      .def_property_readonly("is_dense",
                             [](const Operator& f) { return !f.transport->report().compression; })
      .def_property_readonly("report", &report_of)
      .def_property_readonly("raw_row_sums",
                             [](const Operator& f) { return f.transport->report().row_sums; })
      .def("apply",
           [](const Operator& f, const Eigen::MatrixXd& radiosity) {
             return unlocked([&] { return f.transport->apply(radiosity); });
           })
      .def("apply_error",
           [](const Operator& f, const Eigen::MatrixXd& radiosity) {
             return unlocked([&] { return f.transport->apply_error(radiosity); });
           })
      .def("row", [](const Operator& f,
                     Index i) { return unlocked([&] { return rows_of(*f.transport).row(i); }); })
      .def("row_error",
           [](const Operator& f, Index i) {
             return unlocked([&] { return rows_of(*f.transport).row_error(i); });
           })
      .def("by_surface",
           [](const Operator& f) {
             return unlocked([&] { return surface_form_factors(*f.mesh, *f.transport); });
           })
      .def("by_surface_error",
           [](const Operator& f) {
             return unlocked([&] { return surface_form_factor_errors(*f.mesh, *f.transport); });
           })
      .def("csr", &csr)
      .def("save", &save);
  module.def("load", &load);
  module.def("polygons_of", [](const Scene& scene) {
    return std::make_shared<PatchMesh>(unlocked([&] { return meshing::make_patches(scene); }));
  });
}

}  // namespace python
