#include "io/scene_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <utility>
#include <vector>

#include "io/json_scene.h"
#include "io/line_reader.h"
#include "io/mesh_file.h"
#include "io/mtl_reader.h"

namespace io {
namespace {

using radiosity::Bands;
using radiosity::Scene;

constexpr std::array<std::pair<std::string_view, double>, 7> kUnits = {{
    {"m", 1},
    {"mm", 1e-3},
    {"cm", 1e-2},
    {"in", 0.0254},
    {"ft", 0.3048},
    {"km", 1e3},
    {"um", 1e-6},
}};

/// Gives surfaces without a material a grey one, and says so.
void complete_materials(Scene& scene) {
  std::vector<std::string> names;
  for (const auto& surface : scene.surfaces) {
    if (surface.material < 0) names.push_back(surface.name);
  }
  if (names.empty()) return;
  std::string who = "surface " + names.front();
  if (names.size() > 1) who += fmt::format(" and {} more", names.size() - 1);
  if (scene.materials.empty()) {
    who = "the file";
    scene.bands = {.kind = Bands::Kind::grey, .wavelengths = {}};
  }
  const auto material = static_cast<int>(scene.materials.size());
  scene.materials.push_back(
      {.name = "default",
       .reflectance = Eigen::VectorXd::Constant(scene.bands.count(), kDefaultReflectance),
       .emission = {}});
  for (auto& surface : scene.surfaces) {
    if (surface.material < 0) surface.material = material;
  }
  scene.warnings.push_back(fmt::format("{}: {} has no material; its reflectance is {}",
                                       scene.source, who, kDefaultReflectance));
}

Scene read_mesh_scene(const std::filesystem::path& path, const ReadOptions& options) {
  const double scale = metres_per_unit(options.unit.value_or("m"));
  Scene scene = read_mesh(path, options.progress);
  scene.source = path.string();
  for (auto& vertex : scene.vertices) vertex *= scale;
  scene.precision *= scale;
  complete_materials(scene);
  return scene;
}

}  // namespace

Scene read_scene(const std::filesystem::path& path, const ReadOptions& options) {
  Scene scene = lower_extension(path) == ".json" ? read_json_scene(path, options)
                                                 : read_mesh_scene(path, options);
  if (options.precision) scene.precision = *options.precision;
  scene.files.push_back(path);
  for (const auto& vertex : scene.vertices) {
    if (!vertex.allFinite()) fail(path, "a coordinate in metres is too large for a number");
  }
  return scene;
}

double metres_per_unit(const std::string& unit) {
  std::vector<std::string_view> names;
  for (const auto& [name, metres] : kUnits) {
    if (unit == name) return metres;
    names.push_back(name);
  }
  throw radiosity::SceneError(
      fmt::format("unknown unit \"{}\", expected one of {}", unit, fmt::join(names, ", ")));
}

}  // namespace io
