#include "io/scene/json_surfaces.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>
#include <span>
#include <vector>

#include "io/base/extension.h"
#include "io/base/input_checks.h"
#include "io/base/rounding.h"
#include "io/mesh/mesh_file.h"
#include "io/mesh/texture_coordinates.h"
#include "io/scene/json_transform.h"
#include "io/scene/light_factor.h"
#include "io/scene/read_options.h"
#include "io/scene/scene_keys.h"

namespace io {
namespace {

using radiosity::Bands;
using radiosity::Emission;
using radiosity::Index;
using radiosity::Material;
using radiosity::Progress;
using radiosity::Scene;
using radiosity::Surface;
using radiosity::Vec3;

/// Index of the material that the surface names by `key`, or -1 if it names none.
int find_material(const JsonItem& surface, std::string_view key, const Scene& scene,
                  std::size_t n_materials) {
  const auto item = surface.find(key);
  if (!item) return -1;
  const std::string name = item->text();
  std::vector<std::string_view> names;
  for (std::size_t i = 0; i < n_materials; ++i) {
    if (scene.materials[i].name == name) return static_cast<int>(i);
    names.emplace_back(scene.materials[i].name);
  }
  item->fail(
      fmt::format("unknown material \"{}\", expected one of {}", name, fmt::join(names, ", ")));
}

/// Appends a polygon given by indices from 0 to n_vertices - 1, which first_vertex is added to.
void add_polygon(const JsonItem& polygon, const std::vector<std::int64_t>& face,
                 std::int64_t n_vertices, std::int64_t first_vertex, std::int32_t surface,
                 Scene& scene) {
  if (const auto problem = face_problem(face, n_vertices)) polygon.fail(*problem);
  std::vector<std::int32_t> corners;
  for (const auto index : face) corners.push_back(static_cast<std::int32_t>(first_vertex + index));
  scene.add_polygon(corners, surface);
}

/// Polygons that are lists of indices into `vertices`.
void add_indexed_polygons(const JsonItem& vertices, const JsonItem& polygons, std::int32_t surface,
                          Scene& scene) {
  const auto first_vertex = static_cast<std::int64_t>(scene.vertices.size());
  const auto n_vertices = static_cast<std::int64_t>(vertices.size());
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const auto point = as_point(vertices.value()[i]);
    scene.vertices.push_back(point ? *point : vertices[i].point());
  }
  std::vector<std::int64_t> face;
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    const JsonItem polygon = polygons[i];
    face.clear();
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      const Json& index = polygon.value()[k];
      if (!index.is_number_integer()) polygon[k].fail("expected an index into \"vertices\"");
      face.push_back(index.get<std::int64_t>());
    }
    add_polygon(polygon, face, n_vertices, first_vertex, surface, scene);
  }
}

/// Polygons that are lists of points.
void add_point_polygons(const JsonItem& polygons, std::int32_t surface, Scene& scene) {
  std::vector<std::int64_t> face;
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    const JsonItem polygon = polygons[i];
    const auto first_vertex = static_cast<std::int64_t>(scene.vertices.size());
    face.clear();
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      if (polygon.value()[k].is_number()) {
        polygon[k].fail("expected a point [x, y, z]; indices need \"vertices\" in the surface");
      }
      const auto point = as_point(polygon.value()[k]);
      scene.vertices.push_back(point ? *point : polygon[k].point());
      face.push_back(static_cast<std::int64_t>(k));
    }
    add_polygon(polygon, face, static_cast<std::int64_t>(face.size()), first_vertex, surface,
                scene);
  }
}

/// With coordinates in the scene's unit.
void add_inline_surface(const JsonItem& item, Surface surface, Scene& scene) {
  for (const std::string_view key : {"object", "transform", "unit"}) {
    if (item.has(key)) item.fail(fmt::format("\"{}\" belongs to a \"mesh\" only", key));
  }
  if (surface.material < 0) (void)item.at("material");  // tells that it is missing
  const auto index = static_cast<std::int32_t>(scene.surfaces.size());
  scene.surfaces.push_back(std::move(surface));
  const JsonItem polygons = item.at("polygons");
  if (polygons.size() == 0) polygons.fail("has no polygons");
  if (const auto vertices = item.find("vertices")) {
    add_indexed_polygons(*vertices, polygons, index, scene);
  } else {
    add_point_polygons(polygons, index, scene);
  }
}

/// Metres per unit of a mesh file: as the surface says; metre for glTF, which has no other; else
/// as the scene says.
double mesh_unit(const JsonItem& item, const std::string& file, double scene_unit) {
  if (const auto unit = item.find("unit")) return read_unit(*unit);
  const std::string extension = lower_case_extension(file);
  return extension == ".gltf" || extension == ".glb" ? 1.0 : scene_unit;
}

/// Appends the mesh's vertices in metres, and takes up what they are off, by the largest share that
/// the three coordinates have in one.
void add_vertices(const JsonItem& item, const Scene& mesh, double unit_of_mesh, double unit,
                  Scene& scene) {
  Eigen::Affine3d transform = Eigen::Affine3d::Identity();
  if (const auto given = item.find("transform")) transform = read_transform(*given);
  transform.translation() *= unit;
  transform.linear() *= unit_of_mesh;
  for (const Vec3& vertex : mesh.vertices) scene.vertices.push_back(transform * vertex);
  const double gain = transform.linear().cwiseAbs().rowwise().sum().maxCoeff();
  scene.precision = std::max(scene.precision, gain * mesh.precision);
}

bool is_mirrored(const JsonItem& item) {
  const auto transform = item.find("transform");
  return transform && read_transform(*transform).linear().determinant() < 0;
}

/// Whether values for each band of a mesh are values for the scene's, but for one that is for all.
bool fit(const Bands& of_mesh, const Bands& of_scene) {
  return of_mesh.kind == of_scene.kind && of_mesh.wavelengths == of_scene.wavelengths &&
         of_mesh.edges == of_scene.edges;
}

const char* kind_name(const Bands& bands) {
  switch (bands.kind) {
    case Bands::Kind::grey:
      return "grey";
    case Bands::Kind::rgb:
      return "RGB";
    case Bands::Kind::solar_infrared:
      return "solar and infrared";
    case Bands::Kind::thermal:
      return "thermal";
    case Bands::Kind::wavelengths:
      break;
  }
  return "wavelengths";
}

/// Indices of the mesh's materials in the scene, to which they are appended.
std::vector<int> add_materials(const JsonItem& item, const Scene& mesh, const std::string& file,
                               Scene& scene) {
  const bool is_for_all = mesh.bands.kind == Bands::Kind::grey;
  std::vector<int> indices;
  for (const auto& material : mesh.materials) {
    const bool is_hot = material.emission.kind == Emission::Kind::temperature;
    if (!fit(mesh.bands, scene.bands) && (!is_for_all || is_hot)) {
      item.fail(
          fmt::format("the materials of {} have {} bands ({}), the scene has {} ({}); give "
                      "the surface a \"material\"",
                      file, mesh.bands.count(), kind_name(mesh.bands), scene.bands.count(),
                      kind_name(scene.bands)));
    }
    indices.push_back(static_cast<int>(scene.materials.size()));
    scene.materials.push_back(material);
    if (fit(mesh.bands, scene.bands)) continue;
    const Index n = scene.bands.count();
    Material& added = scene.materials.back();
    added.reflectance = Eigen::VectorXd::Constant(n, material.reflectance[0]);
    if (added.emission.kind == Emission::Kind::none) continue;
    added.emission.value = Eigen::VectorXd::Constant(n, material.emission.value[0]);
  }
  return indices;
}

/// Whether each of the mesh's surfaces is taken: all, or the one that `object` names.
std::vector<bool> chosen_surfaces(const JsonItem& item, const Scene& mesh) {
  const auto object = item.find("object");
  if (!object) return std::vector<bool>(mesh.surfaces.size(), true);
  const std::string name = object->text();
  std::vector<bool> chosen;
  std::vector<std::string_view> names;
  for (const auto& surface : mesh.surfaces) {
    chosen.push_back(surface.name == name);
    names.emplace_back(surface.name);
  }
  if (std::find(chosen.begin(), chosen.end(), true) == chosen.end()) {
    object->fail(fmt::format("no surface \"{}\" in the mesh, expected one of {}", name,
                             fmt::join(names, ", ")));
  }
  return chosen;
}

/// Appends the chosen surfaces; returns their indices in the scene, -1 for those left out.
std::vector<std::int32_t> add_mesh_surfaces(const JsonItem& item, const Surface& given,
                                            const Scene& mesh, const std::string& file,
                                            Scene& scene) {
  const std::vector<bool> chosen = chosen_surfaces(item, mesh);
  const bool has_several = std::count(chosen.begin(), chosen.end(), true) > 1;
  std::vector<int> materials;
  if (given.material < 0) materials = add_materials(item, mesh, file, scene);
  std::vector<std::int32_t> indices;
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    indices.push_back(chosen[i] ? static_cast<std::int32_t>(scene.surfaces.size()) : -1);
    if (!chosen[i]) continue;
    Surface surface = mesh.surfaces[i];
    surface.name = has_several ? given.name + "/" + surface.name : given.name;
    if (item.has("two_sided")) surface.two_sided = given.two_sided;
    surface.emission_factor = given.emission_factor;
    surface.back_material = given.back_material;
    surface.is_shield = given.is_shield;
    if (given.material < 0 && surface.material < 0) {
      item.fail(fmt::format("has no \"material\", and {} gives none to its surface \"{}\"", file,
                            mesh.surfaces[i].name));
    }
    surface.material = given.material < 0 ? materials[surface.material] : given.material;
    scene.surfaces.push_back(std::move(surface));
  }
  return indices;
}

void add_mesh(const JsonItem& item, const Surface& given, const std::filesystem::path& folder,
              double unit, const Progress& progress, FileScene& result) {
  Scene& scene = result.scene;
  for (const std::string_view key : {"polygons", "vertices"}) {
    if (item.has(key)) item.fail(fmt::format("has both \"mesh\" and \"{}\"", key));
  }
  const std::string file = item.at("mesh").text();
  if (lower_case_extension(file) == ".json") {
    item.at("mesh").fail(
        "is a scene, expected a mesh file: .obj, .off, .ply, .stl, .gltf, .glb, .msh, .vtk, .vtp, "
        ".vtu");
  }
  const FileScene read =
      read_mesh(folder / file,
                given.material < 0 ? MeshMaterials::wanted : MeshMaterials::not_needed, progress);
  const Scene& mesh = read.scene;
  scene.files.push_back(folder / file);
  scene.files.insert(scene.files.end(), mesh.files.begin(), mesh.files.end());
  const auto surfaces = add_mesh_surfaces(item, given, mesh, file, scene);
  const auto first_vertex = static_cast<std::int64_t>(scene.vertices.size());
  add_vertices(item, mesh, mesh_unit(item, file, unit), unit, scene);

  // A mirroring transform reverses the sense of the corners: turned back, the side that emits is
  // the mirror image of the side that did.
  const bool reverse = is_mirrored(item);
  std::vector<std::int32_t> corners;
  for (Eigen::Index i = 0; i < mesh.n_polygons(); ++i) {
    const std::int32_t surface = surfaces[mesh.polygon_surface[i]];
    if (surface < 0) continue;
    corners.clear();
    for (const auto index : mesh.polygon(i)) {
      corners.push_back(static_cast<std::int32_t>(first_vertex + index));
    }
    if (reverse) std::reverse(corners.begin(), corners.end());
    scene.add_polygon(corners, surface);
    append_texture_coordinates(mesh, i, reverse, scene);
  }
  scene.warnings.insert(scene.warnings.end(), mesh.warnings.begin(), mesh.warnings.end());
  result.repairs.insert(result.repairs.end(), read.repairs.begin(), read.repairs.end());
}

/// Reads the surfaces whose polygons stand in the scene file, and judges their coordinates as these
/// are written: each surface by itself, for one may come from elsewhere, and all together.
class InlinePoints {
 public:
  InlinePoints(double unit, Scene& scene) : unit_(unit), scene_(scene) {}

  void add(const JsonItem& item, Surface surface) {
    const std::size_t first = scene_.vertices.size();
    add_inline_surface(item, std::move(surface), scene_);
    const std::span<Vec3> added = std::span(scene_.vertices).subspan(first);
    precision_ = std::max(precision_, found_rounding(added).precision);
    all_.insert(all_.end(), added.begin(), added.end());
    for (Vec3& vertex : added) vertex *= unit_;
  }

  void find_precision() {
    const Rounding rounding = found_rounding(all_);
    const double found = std::max(precision_, rounding.precision);
    scene_.precision = std::max(scene_.precision, unit_ * found);
    if (const auto warning = rounding_warning(rounding)) {
      scene_.warnings.push_back(scene_.source + ": " + *warning);
    }
  }

 private:
  double unit_;
  Scene& scene_;
  double precision_ = 0;
  std::vector<Vec3> all_;
};

/// Backs and shields must be of surfaces with two sides, and shields have no temperature given. The
/// place told is the list's, for one item may have become several surfaces.
void check_sides(const JsonItem& surfaces, const Scene& scene) {
  for (const Surface& surface : scene.surfaces) {
    if (!surface.is_shield && surface.back_material < 0) continue;
    const char* key = surface.is_shield ? "shield" : "back";
    if (!surface.two_sided) {
      surfaces.fail(fmt::format("\"{}\" has a \"{}\", but one side; expected \"two_sided\": true",
                                surface.name, key));
    }
    if (!surface.is_shield) continue;
    if (scene.bands.kind != Bands::Kind::grey) {
      surfaces.fail(
          fmt::format("\"{}\" is a shield, which needs \"bands\": \"grey\"", surface.name));
    }
    for (const int index : {surface.material, surface.back_material}) {
      if (index < 0) continue;
      const Material& material = scene.materials[index];
      const Emission::Kind kind = material.emission.kind;
      if (kind == Emission::Kind::none || kind == Emission::Kind::heat_flux ||
          kind == Emission::Kind::heat_power) {
        continue;
      }
      surfaces.fail(
          fmt::format("\"{}\" is a shield, whose temperature follows from the heat, but its "
                      "material \"{}\" has a temperature or emission",
                      surface.name, material.name));
    }
  }
}

}  // namespace

double read_unit(const JsonItem& item) {
  const std::string name = item.text();
  try {
    return metres_per_unit(name);
  } catch (const radiosity::SceneError& error) {
    item.fail(error.what());
  }
}

void add_surfaces(const JsonItem& surfaces, const std::filesystem::path& folder, double unit,
                  const Progress& progress, FileScene& file) {
  Scene& scene = file.scene;
  const std::size_t n_materials = scene.materials.size();  // those of meshes come behind
  std::set<std::string> names;
  InlinePoints inline_points(unit, scene);
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    progress.check();
    const JsonItem item = surfaces[i];
    item.check_keys(keys::kSurface);
    if (const auto description = item.find("description")) (void)description->text();
    const auto two_sided = item.find("two_sided");
    const auto light = item.find("light");
    Surface surface{.name = item.at("name").text(),
                    .material = find_material(item, "material", scene, n_materials),
                    .two_sided = two_sided && two_sided->boolean(),
                    .emission_factor = light ? read_light_factor(*light) : 1};
    surface.back_material = find_material(item, "back", scene, n_materials);
    const auto shield = item.find("shield");
    surface.is_shield = shield && shield->boolean();
    if (!names.insert(surface.name).second) {
      item.fail(fmt::format("a surface named \"{}\" exists already", surface.name));
    }
    if (item.has("mesh")) {
      add_mesh(item, surface, folder, unit, progress, file);
    } else if (item.has("polygons")) {
      inline_points.add(item, std::move(surface));
    } else {
      item.fail("expected either \"mesh\" or \"polygons\"");
    }
  }
  pad_texture_coordinates(scene);
  inline_points.find_precision();
  check_sides(surfaces, scene);
}

}  // namespace io
