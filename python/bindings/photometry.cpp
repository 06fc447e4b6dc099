#include "python/bindings/photometry.h"

#include <pybind11/eigen.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <array>
#include <vector>

#include "io/light/photometric_file.h"
#include "python/bindings/arrays.h"
#include "python/bindings/work.h"
#include "radiosity/scene/photometry.h"
#include "study/ugr_table.h"

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

/// The tables along C0 and along C90 of rooms, n x 2, and reflectances, k x 3.
py::tuple ugr_table(const Photometry& photometry, const Eigen::MatrixXd& rooms,
                    const Eigen::MatrixXd& reflectances, double height, double spacing,
                    const py::object& report, std::size_t n_threads) {
  study::UgrTableOptions options{.height = height, .spacing = spacing};
  if (rooms.rows() > 0) options.rooms.clear();
  for (Index k = 0; k < rooms.rows(); ++k) options.rooms.push_back({rooms(k, 0), rooms(k, 1)});
  if (reflectances.rows() > 0) options.reflectances.clear();
  for (Index k = 0; k < reflectances.rows(); ++k) {
    options.reflectances.push_back({reflectances(k, 0), reflectances(k, 1), reflectances(k, 2)});
  }
  study::UgrTable table;
  run_work({report, n_threads}, [&](const study::StudyEvents& events) {
    table = study::make_ugr_table(photometry, options, events);
  });
  std::vector<std::array<double, 2>> sides;
  for (const study::UgrRoom& room : table.made_by.rooms) sides.push_back({room.across, room.along});
  return py::make_tuple(sides, table.made_by.reflectances, table.along_c0, table.along_c90);
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
      .def("ugr_table", &ugr_table)
      .def("spread", [](const Photometry& self, double plane, double share) {
        return spread(self.web, plane, share);
      });
  module.def("read_photometry", &read_photometry);
}

}  // namespace python
