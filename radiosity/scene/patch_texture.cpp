#include "radiosity/scene/patch_texture.h"

#include <algorithm>
#include <cmath>
#include <span>
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

/// The mean over `part` of a polygon, convex or the polygon itself, m.
TextureMean mean_over(const Scene& scene, Index polygon, const Texture& texture,
                      std::span<const Vec3> part) {
  if (scene.texture_coordinates.empty()) return texture_mean(texture);
  const std::span<const std::int32_t> corners = scene.polygon(polygon);
  std::vector<Vec3> points;
  Outline coordinates;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const auto corner = static_cast<std::size_t>(scene.first_corner[polygon]) + k;
    const Vector2d& coordinate = scene.texture_coordinates[corner];
    if (!coordinate.allFinite()) return texture_mean(texture);
    coordinates.push_back(coordinate);
    points.push_back(scene.vertices[corners[k]]);
  }
  const Frame frame = frame_of(points);
  Outline places;
  for (const Vec3& point : points) places.push_back(frame.of(point));
  Outline outline;
  for (const Vec3& point : part) outline.push_back(frame.of(point));
  const LinearMap map = fitted(places, coordinates);
  if (fits(map, places, coordinates) || !is_convex(places)) {
    return texture_mean(texture, mapped(map, outline));
  }
  if (area_of(outline) < 0) std::reverse(outline.begin(), outline.end());  // a back
  return mean_by_triangles(texture, places, coordinates, outline);
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

}  // namespace radiosity
