#include "python/bindings/scene.h"

#include <pybind11/eigen.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "io/base/rounding.h"
#include "io/result/given_heat_file.h"
#include "io/scene/scene_file.h"
#include "io/scene/scene_writer.h"
#include "python/bindings/arrays.h"
#include "python/bindings/work.h"
#include "radiosity/scene/scenario.h"
#include "radiosity/scene/scene.h"

namespace python {
namespace {

namespace py = pybind11;
using namespace radiosity;

/// Of arrays that were checked, with surfaces that are black in one grey band.
Scene scene_of_mesh(const Array<double>& vertices, const Array<std::int32_t>& corners,
                    const Array<std::int64_t>& first_corner, const Array<std::int32_t>& surface,
                    const std::vector<std::string>& names, const std::vector<bool>& two_sided,
                    std::optional<double> precision, bool is_single) {
  Scene scene;
  scene.source = "mesh";
  scene.bands.kind = Bands::Kind::grey;
  scene.vertices = points_of(vertices);
  scene.corners = values_of(corners);
  scene.first_corner = values_of(first_corner);
  scene.polygon_surface = values_of(surface);
  scene.materials.push_back({"black", Eigen::VectorXd::Zero(1), {}});
  for (std::size_t s = 0; s < names.size(); ++s) {
    scene.surfaces.push_back({names[s], 0, two_sided[s]});
  }
  const auto found = is_single ? io::single_rounding : [](std::span<const Vec3> points, double) {
    return io::found_rounding(points);
  };
  scene.precision = precision ? *precision : found(scene.vertices, 0).precision;
  return scene;
}

Scene read(const std::filesystem::path& path, const std::optional<std::string>& unit,
           std::optional<double> precision, bool strict, const py::object& report) {
  Scene scene;
  run_work({.report = report}, [&](const study::StudyEvents& events) {
    scene = io::read_scene(
        path,
        {.unit = unit, .precision = precision, .strict = strict, .progress = events.progress});
    for (const std::string& warning : scene.warnings) events.warn(warning);
  });
  return scene;
}

Scene changed(const Scene& scene, const std::map<std::string, double>& lights,
              const std::map<std::string, Eigen::VectorXd>& reflectances) {
  Scenario scenario{.name = "python"};
  for (const auto& [surfaces, factor] : lights) scenario.lights.push_back({surfaces, factor});
  for (const auto& [materials, values] : reflectances) {
    scenario.paints.push_back({materials, values});
  }
  return scene_of(scene, scenario);
}

const char* bands_name(const Scene& scene) {
  switch (scene.bands.kind) {
    case Bands::Kind::grey:
      return "grey";
    case Bands::Kind::rgb:
      return "rgb";
    case Bands::Kind::solar_infrared:
      return "solar-infrared";
    case Bands::Kind::thermal:
      return "thermal";
    case Bands::Kind::wavelengths:
      break;
  }
  return "wavelengths";
}

template <typename Item>
std::vector<std::string> names_of(const std::vector<Item>& items) {
  std::vector<std::string> names;
  for (const Item& item : items) names.push_back(item.name);
  return names;
}

GivenHeat::Kind heat_kind(bool is_temperature) {
  return is_temperature ? GivenHeat::Kind::temperature : GivenHeat::Kind::heat_flux;
}

/// A value for each patch or polygon, NaN where nothing is given.
Scene with_heat_values(Scene scene, bool is_temperature, const Eigen::VectorXd& values) {
  GivenHeat given{.kind = heat_kind(is_temperature),
                  .of = GivenHeat::Of::cells,
                  .values = {},
                  .source = is_temperature ? "temperatures" : "heat_fluxes"};
  for (Index i = 0; i < values.size(); ++i) given.values.emplace_back(i, values[i]);
  scene.given_heat.push_back(std::move(given));
  return scene;
}

Scene with_heat_file(Scene scene, bool is_temperature, const std::filesystem::path& path) {
  scene.given_heat.push_back(io::read_given_heat(path, heat_kind(is_temperature)));
  scene.files.push_back(path);
  return scene;
}

}  // namespace

void bind_scene(py::module_& module) {
  py::class_<Scene>(module, "Scene")
      .def_readonly("source", &Scene::source)
      .def_readonly("warnings", &Scene::warnings)
      .def_readonly("precision", &Scene::precision)
      .def_property_readonly("n_polygons", &Scene::n_polygons)
      .def_property_readonly("bands", &bands_name)
      .def_property_readonly("n_bands", [](const Scene& scene) { return scene.bands.count(); })
      .def_property_readonly(
          "wavelengths", [](const Scene& scene) { return copied_array(scene.bands.wavelengths); })
      .def_property_readonly("surface_names",
                             [](const Scene& scene) { return names_of(scene.surfaces); })
      .def_property_readonly("material_names",
                             [](const Scene& scene) { return names_of(scene.materials); })
      .def_property_readonly("vertices",
                             [](const Scene& scene) { return points_array(scene.vertices); })
      .def_property_readonly("corners",
                             [](const Scene& scene) { return copied_array(scene.corners); })
      .def_property_readonly("first_corner",
                             [](const Scene& scene) { return copied_array(scene.first_corner); })
      .def_property_readonly("polygon_surface",
                             [](const Scene& scene) { return copied_array(scene.polygon_surface); })
      .def_property_readonly("two_sided",
                             [](const Scene& scene) {
                               std::vector<bool> result;
                               for (const Surface& surface : scene.surfaces) {
                                 result.push_back(surface.two_sided);
                               }
                               return result;
                             })
      .def("with_heat_values", &with_heat_values)
      .def("with_heat_file", &with_heat_file)
      .def("changed", &changed, py::arg("lights"), py::arg("reflectances"))
      .def("write", [](const Scene& scene, const std::filesystem::path& path) {
        io::write_scene(path, scene);
      });
  module.def("scene_of_mesh", &scene_of_mesh);
  module.def("read_scene", &read);
}

}  // namespace python
