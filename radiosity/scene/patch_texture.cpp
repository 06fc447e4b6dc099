#include "radiosity/scene/patch_texture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "radiosity/base/geometry.h"
#include "radiosity/scene/patch_material.h"

namespace radiosity {
namespace {

using Eigen::Vector2d;
using Outline = std::vector<Vector2d>;

/// Coordinates count as linear within this share of their span: files round them to 6 digits.
constexpr double kLinear = 1e-6;

/// A polygon's plane: points of it by two coordinates, m.
struct Frame {
  Vec3 origin;
  Vec3 across;
  Vec3 up;

  [[nodiscard]] Vector2d of(const Vec3& point) const {
    return {(point - origin).dot(across), (point - origin).dot(up)};
  }
};

Frame frame_of(std::span<const Vec3> corners) {
  Vec3 normal = Vec3::Zero();
  for (std::size_t k = 2; k < corners.size(); ++k) {
    normal += (corners[k - 1] - corners[0]).cross(corners[k] - corners[0]);
  }
  normal.stableNormalize();
  Index least = 0;
  normal.cwiseAbs().minCoeff(&least);
  const Vec3 across = normal.cross(Vec3::Unit(least)).normalized();
  return {corners[0], across, normal.cross(across)};
}

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

double area_of(const Outline& outline) {
  double area = 0;
  for (std::size_t k = 2; k < outline.size(); ++k) {
    area += cross(outline[k - 1] - outline[0], outline[k] - outline[0]) / 2;
  }
  return area;
}

/// Texture coordinates that are linear in place.
struct LinearMap {
  Eigen::Matrix<double, 2, 3> matrix;

  [[nodiscard]] Vector2d of(const Vector2d& place) const {
    return matrix.leftCols<2>() * place + matrix.col(2);
  }
};

/// Of three corners that are not on a line.
LinearMap through(const Outline& places, const Outline& coordinates) {
  Eigen::Matrix2d sides;
  sides << places[1] - places[0], places[2] - places[0];
  Eigen::Matrix2d ways;
  ways << coordinates[1] - coordinates[0], coordinates[2] - coordinates[0];
  LinearMap map;
  map.matrix.leftCols<2>() = ways * sides.inverse();
  map.matrix.col(2) = coordinates[0] - map.matrix.leftCols<2>() * places[0];
  return map;
}

/// By least squares.
LinearMap fitted(const Outline& places, const Outline& coordinates) {
  if (places.size() == 3) return through(places, coordinates);
  const auto n = static_cast<Index>(places.size());
  Eigen::MatrixXd system(n, 3);
  Eigen::MatrixXd values(n, 2);
  for (Index k = 0; k < n; ++k) {
    system.row(k) << places[static_cast<std::size_t>(k)].transpose(), 1;
    values.row(k) = coordinates[static_cast<std::size_t>(k)].transpose();
  }
  return {system.colPivHouseholderQr().solve(values).transpose()};
}

bool fits(const LinearMap& map, const Outline& places, const Outline& coordinates) {
  double span = 0;
  double off = 0;
  for (std::size_t k = 0; k < places.size(); ++k) {
    span = std::max(span, (coordinates[k] - coordinates[0]).lpNorm<Eigen::Infinity>());
    off = std::max(off, (map.of(places[k]) - coordinates[k]).lpNorm<Eigen::Infinity>());
  }
  return off <= kLinear * span;
}

bool is_convex(const Outline& outline) {
  for (std::size_t k = 0; k < outline.size(); ++k) {
    const Vector2d& corner = outline[(k + 1) % outline.size()];
    const Vector2d next = outline[(k + 2) % outline.size()] - corner;
    if (cross(corner - outline[k], next) < 0) return false;
  }
  return true;
}

/// What of a convex outline lies to the left of the line from a to b (Sutherland & Hodgman 1974).
Outline left_of(const Outline& outline, const Vector2d& a, const Vector2d& b) {
  Outline kept;
  for (std::size_t k = 0; k < outline.size(); ++k) {
    const Vector2d& from = outline[k];
    const Vector2d& to = outline[(k + 1) % outline.size()];
    const double from_side = cross(b - a, from - a);
    const double to_side = cross(b - a, to - a);
    if (from_side >= 0) kept.push_back(from);
    if (from_side * to_side < 0) {
      kept.emplace_back(from + from_side / (from_side - to_side) * (to - from));
    }
  }
  return kept;
}

Outline mapped(const LinearMap& map, const Outline& outline) {
  Outline result;
  for (const Vector2d& point : outline) result.push_back(map.of(point));
  return result;
}

/// The mean over the parts of an outline that lie in the triangles from the first corner.
TextureMean mean_by_triangles(const Texture& texture, const Outline& places,
                              const Outline& coordinates, const Outline& part) {
  TextureMean sum;
  double area = 0;
  for (std::size_t k = 2; k < places.size(); ++k) {
    const Outline triangle = {places[0], places[k - 1], places[k]};
    if (!(area_of(triangle) > 0)) continue;
    Outline piece = part;
    for (std::size_t side = 0; side < 3 && piece.size() > 2; ++side) {
      piece = left_of(piece, triangle[side], triangle[(side + 1) % 3]);
    }
    const double weight = piece.size() > 2 ? area_of(piece) : 0;
    if (!(weight > 0)) continue;
    const LinearMap map = through(triangle, {coordinates[0], coordinates[k - 1], coordinates[k]});
    const TextureMean mean = texture_mean(texture, mapped(map, piece));
    sum.mean += weight * mean.mean;
    sum.square += weight * mean.square;
    area += weight;
  }
  if (!(area > 0)) return texture_mean(texture);
  return {.mean = sum.mean / area, .square = sum.square / area};
}

/// The texture coordinates of a polygon.
struct PolygonMap {
  Frame frame;
  Outline places;
  Outline coordinates;
  LinearMap map;   // of all of it, or by least squares
  bool is_linear;  // else by the triangles from the first corner

  [[nodiscard]] Vector2d of(const Vec3& point) const;
};

/// Of the first of the triangles that a point is least outside of.
Vector2d PolygonMap::of(const Vec3& point) const {
  const Vector2d place = frame.of(point);
  if (is_linear) return map.of(place);
  std::size_t best = 2;
  double least_outside = std::numeric_limits<double>::infinity();
  for (std::size_t k = 2; k < places.size(); ++k) {
    const std::array<Vector2d, 3> triangle = {places[0], places[k - 1], places[k]};
    double outside = 0;
    for (std::size_t side = 0; side < 3; ++side) {
      const Vector2d& a = triangle[side];
      outside = std::max(outside, -cross(triangle[(side + 1) % 3] - a, place - a));
    }
    const bool has_area = cross(triangle[1] - triangle[0], triangle[2] - triangle[0]) > 0;
    if (!has_area || outside >= least_outside) continue;
    best = k;
    least_outside = outside;
  }
  return through({places[0], places[best - 1], places[best]},
                 {coordinates[0], coordinates[best - 1], coordinates[best]})
      .of(place);
}

/// Empty if a corner has none.
std::optional<PolygonMap> map_of(const Scene& scene, Index polygon) {
  if (scene.texture_coordinates.empty()) return std::nullopt;
  const std::span<const std::int32_t> corners = scene.polygon(polygon);
  std::vector<Vec3> points;
  PolygonMap result;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const auto corner = static_cast<std::size_t>(scene.first_corner[polygon]) + k;
    const Vector2d& coordinate = scene.texture_coordinates[corner];
    if (!coordinate.allFinite()) return std::nullopt;
    result.coordinates.push_back(coordinate);
    points.push_back(scene.vertices[corners[k]]);
  }
  result.frame = frame_of(points);
  for (const Vec3& point : points) result.places.push_back(result.frame.of(point));
  result.map = fitted(result.places, result.coordinates);
  result.is_linear =
      fits(result.map, result.places, result.coordinates) || !is_convex(result.places);
  return result;
}

/// The mean over `part` of a polygon, convex or the polygon itself, m.
TextureMean mean_over(const Scene& scene, Index polygon, const Texture& texture,
                      std::span<const Vec3> part) {
  const std::optional<PolygonMap> of_polygon = map_of(scene, polygon);
  if (!of_polygon) return texture_mean(texture);
  Outline outline;
  for (const Vec3& point : part) outline.push_back(of_polygon->frame.of(point));
  if (of_polygon->is_linear) return texture_mean(texture, mapped(of_polygon->map, outline));
  if (area_of(outline) < 0) std::reverse(outline.begin(), outline.end());  // a back
  return mean_by_triangles(texture, of_polygon->places, of_polygon->coordinates, outline);
}

}  // namespace

TextureMean patch_texture(const Scene& scene, const PatchMesh& mesh, Index patch,
                          const Texture& texture) {
  std::vector<Vec3> corners;
  for (int k = 0; k < mesh.n_corners(patch); ++k) corners.push_back(mesh.corner(patch, k));
  return mean_over(scene, mesh.polygon[patch], texture, corners);
}

TextureMean polygon_texture(const Scene& scene, Index polygon, const Texture& texture) {
  std::vector<Vec3> corners;
  for (const std::int32_t corner : scene.polygon(polygon)) {
    corners.push_back(scene.vertices[corner]);
  }
  return mean_over(scene, polygon, texture, corners);
}

Eigen::VectorXd mean_of_texture(const Scene& scene, int material) {
  const Texture& texture = *scene.materials[material].texture;
  Eigen::Array3d sum = Eigen::Array3d::Zero();
  double area = 0;
  std::vector<Vec3> corners;
  for (Index i = 0; i < scene.n_polygons(); ++i) {
    const Surface& surface = scene.surfaces[scene.polygon_surface[i]];
    const bool is_back = surface.two_sided && surface.back_material == material;
    if (surface.material != material && !is_back) continue;
    corners.clear();
    for (const std::int32_t corner : scene.polygon(i)) corners.push_back(scene.vertices[corner]);
    const double weight = vector_area(corners).norm();
    sum += weight * polygon_texture(scene, i, texture).mean;
    area += weight;
  }
  return area > 0 ? Eigen::VectorXd(sum / area)
                  : Eigen::VectorXd(texture_mean(texture).mean.matrix());
}

Eigen::VectorXd texture_deviation(const Scene& scene, const PatchMesh& mesh) {
  if (!has_textures(scene)) return {};
  Eigen::VectorXd deviation = Eigen::VectorXd::Zero(mesh.size());
  for (Index i = 0; i < mesh.size(); ++i) {
    const Material& material = scene.materials[material_of(scene, mesh, i)];
    if (!material.texture) continue;
    const TextureMean found = patch_texture(scene, mesh, i, *material.texture);
    deviation[i] = std::sqrt(std::max(0.0, (found.square - found.mean.square()).mean()));
  }
  return deviation;
}

bool has_textures(const Scene& scene) {
  return std::any_of(scene.materials.begin(), scene.materials.end(),
                     [](const Material& material) { return material.texture.has_value(); });
}

struct TextureMap::Polygons {
  std::vector<std::optional<PolygonMap>> maps;  // per polygon of the scene, of those with textures
  std::vector<std::optional<Texture>> of_materials;
  std::vector<int> material;   // per patch
  std::vector<Index> polygon;  // per patch
};

TextureMap::TextureMap(const Scene& scene, const PatchMesh& mesh) {
  if (!has_textures(scene)) return;
  auto polygons = std::make_shared<Polygons>();
  polygons->maps.resize(static_cast<std::size_t>(scene.n_polygons()));
  for (const Material& material : scene.materials) {
    polygons->of_materials.push_back(material.texture);
  }
  for (Index i = 0; i < mesh.size(); ++i) {
    const int material = material_of(scene, mesh, i);
    const auto polygon = static_cast<std::size_t>(mesh.polygon[i]);
    polygons->material.push_back(material);
    polygons->polygon.push_back(mesh.polygon[i]);
    if (scene.materials[material].texture && !polygons->maps[polygon]) {
      polygons->maps[polygon] = map_of(scene, mesh.polygon[i]);
    }
  }
  polygons_ = std::move(polygons);
}

std::optional<Eigen::Array3d> TextureMap::at(Index patch, const Vec3& point) const {
  if (!polygons_ || patch >= static_cast<Index>(polygons_->material.size())) return std::nullopt;
  const auto i = static_cast<std::size_t>(patch);
  const auto& texture = polygons_->of_materials[static_cast<std::size_t>(polygons_->material[i])];
  if (!texture) return std::nullopt;
  const auto& map = polygons_->maps[static_cast<std::size_t>(polygons_->polygon[i])];
  if (!map) return std::nullopt;
  return texture_value(*texture, map->of(point));
}

}  // namespace radiosity
