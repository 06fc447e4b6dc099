#include "io/scene/scene_file.h"

#include <fmt/format.h>

#include <vector>

#include "io/base/extension.h"
#include "io/base/line_reader.h"
#include "io/base/printable.h"
#include "io/mesh/mesh_file.h"
#include "io/mesh/mtl_reader.h"
#include "io/scene/json_scene.h"
#include "meshing/inspect/bad_polygons.h"
#include "radiosity/scene/patch_texture.h"

namespace io {
namespace {

using radiosity::Bands;
using radiosity::Index;
using radiosity::Scene;

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

FileScene read_mesh_scene(const std::filesystem::path& path, const ReadOptions& options) {
  const double scale = metres_per_unit(options.unit.value_or("m"));
  FileScene file = read_mesh(path, MeshMaterials::wanted, options.progress);
  Scene& scene = file.scene;
  scene.source = path.string();
  for (auto& vertex : scene.vertices) vertex *= scale;
  scene.precision *= scale;
  complete_materials(scene);
  return file;
}

/// Of materials with textures, once it is known which polygons count.
void find_mean_reflectances(Scene& scene) {
  for (std::size_t m = 0; m < scene.materials.size(); ++m) {
    if (!scene.materials[m].texture) continue;
    scene.materials[m].reflectance = mean_of_texture(scene, static_cast<int>(m));
  }
}

void refuse_repairs(const std::vector<std::string>& repairs) {
  if (repairs.empty()) return;
  const std::string more =
      repairs.size() > 1 ? fmt::format(" (and {} more faults)", repairs.size() - 1) : "";
  throw radiosity::SceneError(
      printable(repairs.front() + more + "; refused, for reading is strict"));
}

}  // namespace

Scene read_scene(const std::filesystem::path& path, const ReadOptions& options) {
  FileScene file = lower_case_extension(path) == ".json" ? read_json_scene(path, options)
                                                         : read_mesh_scene(path, options);
  if (options.precision) file.scene.precision = *options.precision;
  file.scene.files.push_back(path);
  for (const auto& vertex : file.scene.vertices) {
    if (!vertex.allFinite()) fail(path, "a coordinate in metres is too large for a number");
  }
  options.progress.check();
  const Index n_given = file.scene.n_polygons();
  meshing::CleanScene clean = meshing::leave_out_bad_polygons(std::move(file.scene));
  file.repairs.insert(file.repairs.end(), clean.repairs.begin(), clean.repairs.end());
  if (options.strict) refuse_repairs(file.repairs);
  Scene& scene = clean.scene;
  if (scene.n_polygons() == 0) {
    throw radiosity::SceneError(
        printable(fmt::format("{}; none of {} is left", clean.repairs.front(), n_given)));
  }
  scene.warnings.insert(scene.warnings.end(), file.repairs.begin(), file.repairs.end());
  find_mean_reflectances(scene);
  return std::move(scene);
}

}  // namespace io
