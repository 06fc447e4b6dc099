#include "io/scene/scene_writer.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <fstream>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "io/base/atomic_file.h"
#include "io/scene/json_light_plan.h"
#include "io/scene/json_luminaires.h"
#include "io/scene/point_json.h"
#include "io/scene/sky_writer.h"

namespace io {
namespace {

using radiosity::Bands;
using radiosity::Camera;
using radiosity::Emission;
using radiosity::Index;
using radiosity::kPi;
using radiosity::Material;
using radiosity::Scene;
using radiosity::Surface;
using radiosity::Vec3;

/// In one line. Doubles have the digits that bring back the same double.
std::string text(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

/// Makes names that can be told apart: none empty, none twice.
class UniqueNames {
 public:
  explicit UniqueNames(std::string fallback) : fallback_(std::move(fallback)) {}

  std::string add(const std::string& name) {
    // Bytes that are no UTF-8 are replaced before names are compared.
    const std::string wanted =
        name.empty() ? fallback_ : Json::parse(text(Json(name))).get<std::string>();
    std::string unused = wanted;
    for (int n = 2; !taken_.insert(unused).second; ++n) {
      unused = wanted + "-" + std::to_string(n);
    }
    return unused;
  }

 private:
  std::string fallback_;
  std::set<std::string> taken_;
};

Json bands_json(const Bands& bands) {
  switch (bands.kind) {
    case Bands::Kind::grey:
      return "grey";
    case Bands::Kind::rgb:
      return "rgb";
    case Bands::Kind::solar_infrared:
      if (bands.edges.empty()) return "solar-infrared";
      return {{"split_wavelength", bands.edges.front()}};
    case Bands::Kind::thermal:
      return {{"thermal", bands.edges}};
    case Bands::Kind::wavelengths:
      break;
  }
  return bands.wavelengths;
}

/// One number if all bands have the same, else a list.
Json values_json(const Eigen::VectorXd& values) {
  const bool is_even = std::all_of(values.begin(), values.end(), [&](double value) {
    return value == values[0] && std::signbit(value) == std::signbit(values[0]);
  });
  if (is_even) return values[0];
  return std::vector<double>(values.begin(), values.end());
}

const char* emission_key(Emission::Kind kind) {
  switch (kind) {
    case Emission::Kind::radiance:
      return "radiance";
    case Emission::Kind::exitance:
      return "exitance";
    case Emission::Kind::power:
      return "power";
    case Emission::Kind::heat_flux:
      return "heat_flux";
    case Emission::Kind::heat_power:
      return "heat_power";
    case Emission::Kind::temperature:
    case Emission::Kind::none:
      break;
  }
  return "temperature";
}

Json material_json(const Material& material) {
  Json json = {{"reflectance", values_json(material.reflectance)}};
  if (!material.emissivity_table.empty()) {
    Json table = Json::array();
    for (const auto& [kelvin, emissivity] : material.emissivity_table) {
      table.push_back(Json::array({kelvin, emissivity}));
    }
    json = Json::object();
    json["emissivity"] = std::move(table);
  }
  if (material.emission.kind != Emission::Kind::none) {
    json[emission_key(material.emission.kind)] = values_json(material.emission.value);
  }
  if (material.glazing) json["glazing"] = glazing_json(*material.glazing);
  if (material.maintenance_factor != 1) json["maintenance_factor"] = material.maintenance_factor;
  return json;
}

Json light_json(double factor) { return factor == 0 ? Json("off") : Json(factor); }

/// The number near `guess` that `read` makes `wanted` of, if there is one.
template <typename Read>
std::optional<double> argument_for(double wanted, double guess, const Read& read) {
  constexpr int kSteps = 4;  // last digits to either side
  double candidate = guess;
  for (int k = 0; k < kSteps; ++k) candidate = std::nextafter(candidate, 0);
  for (int k = 0; k <= 2 * kSteps; ++k) {
    if (read(candidate) == wanted) return candidate;
    candidate = std::nextafter(candidate, std::numeric_limits<double>::infinity());
  }
  return std::nullopt;
}

/// The angle in degrees; or, if none has just this one in radian, a focal length and film. Some
/// angles (one in fifty between 52 and 57 degrees) have neither and lose their last bit.
void add_fov(double fov, Json& camera) {
  const double guess = fov * 180 / kPi;
  const auto degrees = argument_for(fov, guess, [](double d) { return d * kPi / 180; });
  if (!degrees) {
    const auto film = argument_for(fov, 2 * std::tan(fov / 2),
                                   [](double height) { return 2 * std::atan(height / 2); });
    if (film) {
      camera["focal_length"] = 1;
      camera["film"] = *film;
      return;
    }
  }
  camera["vertical_fov_deg"] = degrees.value_or(guess);
}

Json camera_json(const Camera& camera) {
  Json json = {{"position", point_json(camera.position)},
               {"direction", point_json(camera.direction)},
               {"up", point_json(camera.up)}};
  add_fov(camera.vertical_fov, json);
  return json;
}

Json sun_json(const radiosity::Sun& sun) {
  return {{"direction", point_json(sun.direction)}, {"irradiance", values_json(sun.irradiance)}};
}

Json symmetry_json(const radiosity::Symmetry& symmetry) {
  Json json = Json::object();
  for (const auto& mirror : symmetry.mirrors) {
    json["mirror"].push_back(
        {{"point", point_json(mirror.point)}, {"normal", point_json(mirror.normal)}});
  }
  if (symmetry.rotation) {
    json["rotation"] = {{"axis", point_json(symmetry.rotation->axis)},
                        {"point", point_json(symmetry.rotation->point)},
                        {"folds", symmetry.rotation->folds}};
  }
  for (const auto& translation : symmetry.translations) {
    json["translation"].push_back(point_json(translation.step));
    json["images"].push_back(translation.n_images);
  }
  return json;
}

/// The polygons of each surface.
std::vector<std::vector<Index>> polygons_by_surface(const Scene& scene) {
  std::vector<std::vector<Index>> polygons(scene.surfaces.size());
  for (Index i = 0; i < scene.n_polygons(); ++i) {
    polygons[scene.polygon_surface[i]].push_back(i);
  }
  return polygons;
}

/// Writes polygons of one surface, line by line.
class PolygonWriter {
 public:
  PolygonWriter(const Scene& scene, std::ostream& stream)
      : scene_(scene), stream_(stream), local_(scene.vertices.size(), -1) {}

  void write(const std::vector<Index>& polygons) {
    used_.clear();
    for (const Index i : polygons) {
      used_.insert(used_.end(), scene_.polygon(i).begin(), scene_.polygon(i).end());
    }
    // Polygons whose corners follow each other in the scene give the same as lists of points.
    const bool are_apart =
        std::adjacent_find(used_.begin(), used_.end(), std::greater_equal<>()) == used_.end();
    if (!are_apart) {
      std::sort(used_.begin(), used_.end());
      used_.erase(std::unique(used_.begin(), used_.end()), used_.end());
      write_vertices();
    }
    stream_ << "     \"polygons\": [";
    const char* separator = "\n      ";
    for (const Index i : polygons) {
      stream_ << std::exchange(separator, ",\n      ") << text(polygon_json(i, are_apart));
    }
    stream_ << "\n     ]";
  }

 private:
  void write_vertices() {
    stream_ << "     \"vertices\": [";
    const char* separator = "\n      ";
    for (std::size_t k = 0; k < used_.size(); ++k) {
      local_[used_[k]] = static_cast<std::int32_t>(k);
      stream_ << std::exchange(separator, ",\n      ")
              << text(point_json(scene_.vertices[used_[k]]));
    }
    stream_ << "\n     ],\n";
  }

  [[nodiscard]] Json polygon_json(Index i, bool as_points) const {
    Json json = Json::array();
    for (const std::int32_t vertex : scene_.polygon(i)) {
      json.push_back(as_points ? point_json(scene_.vertices[vertex]) : Json(local_[vertex]));
    }
    return json;
  }

  const Scene& scene_;
  std::ostream& stream_;
  std::vector<std::int32_t> used_;   // vertices of the surface
  std::vector<std::int32_t> local_;  // per vertex: its index in the surface last written
};

void write_materials(const Scene& scene, const std::vector<std::string>& names,
                     std::ostream& stream) {
  stream << "  \"materials\": {";
  for (std::size_t i = 0; i < names.size(); ++i) {
    stream << (i == 0 ? "\n" : ",\n") << "    " << text(Json(names[i])) << ": "
           << text(material_json(scene.materials[i]));
  }
  stream << "\n  },\n";
}

void write_surfaces(const Scene& scene, const std::vector<std::string>& material_names,
                    std::ostream& stream) {
  const auto polygons = polygons_by_surface(scene);
  PolygonWriter writer(scene, stream);
  UniqueNames names("surface");
  stream << "  \"surfaces\": [";
  const char* separator = "\n    ";
  for (std::size_t i = 0; i < scene.surfaces.size(); ++i) {
    if (polygons[i].empty()) continue;
    const Surface& surface = scene.surfaces[i];
    assert(surface.material >= 0);
    stream << std::exchange(separator, ",\n    ")
           << "{\"name\": " << text(Json(names.add(surface.name)))
           << ", \"material\": " << text(Json(material_names[surface.material]));
    if (surface.two_sided) stream << ", \"two_sided\": true";
    if (surface.back_material >= 0) {
      stream << ", \"back\": " << text(Json(material_names[surface.back_material]));
    }
    if (surface.is_shield) stream << ", \"shield\": true";
    if (surface.emission_factor != 1) {
      stream << ", \"light\": " << text(light_json(surface.emission_factor));
    }
    stream << ",\n";
    writer.write(polygons[i]);
    stream << "}";
  }
  stream << "\n  ]";
}

void write_environment(const Emission& environment, std::ostream& stream) {
  const Json json = {{emission_key(environment.kind), values_json(environment.value)}};
  stream << "  \"environment\": " << text(json) << ",\n";
}

void write_views(const Scene& scene, std::ostream& stream) {
  UniqueNames names("view");
  stream << ",\n  \"views\": {";
  const char* separator = "\n    ";
  for (const radiosity::View& view : scene.views) {
    stream << std::exchange(separator, ",\n    ") << text(Json(names.add(view.name))) << ": "
           << text(camera_json(view.camera));
  }
  stream << "\n  }";
}

void write_luminaires(const Scene& scene, const std::filesystem::path& folder,
                      std::ostream& stream) {
  stream << ",\n  \"luminaires\": [";
  const char* separator = "\n    ";
  for (const Json& luminaire : luminaires_json(scene, folder)) {
    stream << std::exchange(separator, ",\n    ") << text(luminaire);
  }
  stream << "\n  ]";
}

void write_json(const Scene& scene, const std::filesystem::path& folder, std::ostream& stream) {
  UniqueNames names("material");
  std::vector<std::string> material_names;
  for (const Material& material : scene.materials) {
    material_names.push_back(names.add(material.name));
  }
  stream << "{\n";
  if (!scene.name.empty()) stream << "  \"name\": " << text(Json(scene.name)) << ",\n";
  if (!scene.description.empty()) {
    stream << "  \"description\": " << text(Json(scene.description)) << ",\n";
  }
  stream << "  \"unit\": \"m\",\n  \"precision\": " << text(Json(scene.precision))
         << ",\n  \"bands\": " << text(bands_json(scene.bands)) << ",\n";
  write_materials(scene, material_names, stream);
  if (scene.environment.kind != Emission::Kind::none) write_environment(scene.environment, stream);
  write_surfaces(scene, material_names, stream);
  if (scene.sun) stream << ",\n  \"sun\": " << text(sun_json(*scene.sun));
  if (!scene.luminaires.empty()) write_luminaires(scene, folder, stream);
  if (scene.sky) stream << ",\n  \"sky\": " << text(sky_json(scene));
  if (scene.camera) stream << ",\n  \"camera\": " << text(camera_json(*scene.camera));
  if (!scene.views.empty()) write_views(scene, stream);
  if (scene.closed) stream << ",\n  \"closed\": " << (*scene.closed ? "true" : "false");
  if (!scene.symmetry.is_none()) {
    stream << ",\n  \"symmetry\": " << text(symmetry_json(scene.symmetry));
  }
  const Json plan = light_plan_json(scene.light_plan);
  for (const auto& [key, value] : plan.items()) {
    stream << ",\n  \"" << key << "\": " << text(value);
  }
  stream << "\n}\n";
}

}  // namespace

void write_scene(const std::filesystem::path& path, const Scene& scene) {
  write_stream_atomically(
      path, [&](std::ofstream& stream) { write_json(scene, path.parent_path(), stream); });
}

}  // namespace io
