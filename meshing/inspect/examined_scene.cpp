#include "meshing/inspect/examined_scene.h"

#include "radiosity/scene/patch_mesh.h"

namespace meshing {

using radiosity::Index;
using radiosity::Vec3;

bool ExaminedScene::emits(Index polygon) const {
  const auto material = static_cast<std::size_t>(scene.surfaces[surface(polygon)].material);
  return material < scene.materials.size() &&
         scene.materials[material].emission.kind != radiosity::Emission::Kind::none;
}

std::vector<Vec3> ExaminedScene::points(Index polygon) const {
  std::vector<Vec3> result;
  for (const std::int32_t v : polygons.polygon(polygon)) result.push_back(polygons.vertices[v]);
  return result;
}

Vec3 ExaminedScene::center(Index polygon) const {
  const std::span<const std::int32_t> corners = polygons.polygon(polygon);
  const Vec3& first = polygons.vertices[corners[0]];
  Vec3 sum = Vec3::Zero();
  for (const std::int32_t v : corners) sum += polygons.vertices[v] - first;
  return first + sum / static_cast<double>(corners.size());
}

ExaminedScene examine(const radiosity::Scene& scene) {
  ExaminedScene examined{.scene = scene,
                         .polygons = {},
                         .edges = {},
                         .shapes = {},
                         .bounds = {},
                         .size = 0,
                         .thickness = 0};
  for (const std::int32_t corner : scene.corners) examined.bounds.extend(scene.vertices[corner]);
  if (!examined.bounds.isEmpty()) examined.size = examined.bounds.diagonal().norm();
  examined.thickness = radiosity::plane_thickness(examined.bounds, scene.precision);
  // Copies that went through other arithmetic, such as two instances that touch, differ by the last
  // digit that the file has.
  examined.polygons = weld(scene, examined.thickness);
  examined.edges = make_edge_table(examined.polygons);
  examined.shapes.reserve(scene.n_polygons());
  for (Index i = 0; i < scene.n_polygons(); ++i) {
    examined.shapes.push_back(polygon_shape(examined.points(i), scene.precision));
  }
  return examined;
}

}  // namespace meshing
