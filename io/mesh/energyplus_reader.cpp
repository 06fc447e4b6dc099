#include "io/mesh/energyplus_reader.h"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "io/base/flat_difference.h"
#include "io/base/line_reader.h"
#include "io/mesh/energyplus_model.h"
#include "meshing/base/triangulate.h"
#include "radiosity/base/geometry.h"

namespace io {
namespace {

using radiosity::ConvexPolygon;
using radiosity::Scene;
using radiosity::Vec3;

/// How far a window may be off the plane of its wall, and what is cut out of it less than the
/// window, of its size.
constexpr double kOffWall = 1e-4;

bool is_convex(const std::vector<Vec3>& corners, const Vec3& normal) {
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Vec3& b = corners[(k + 1) % corners.size()];
    const Vec3 edge = b - corners[k];
    const Vec3 next = corners[(k + 2) % corners.size()] - b;
    if (normal.dot(edge.cross(next)) < -1e-9 * edge.norm() * next.norm()) return false;
  }
  return corners.size() <= ConvexPolygon::kCapacity / 2;
}

double area_of(std::span<const Vec3> corners) { return radiosity::vector_area(corners).norm(); }

class EnergyPlusScene {
 public:
  EnergyPlusScene(const std::filesystem::path& path, const EnergyPlusModel& model)
      : path_(path), model_(model), windows_(model.surfaces.size()) {}

  FileScene run() {
    scene_.bands = {.kind = radiosity::Bands::Kind::grey, .wavelengths = {}};
    for (const std::string& warning : model_.warnings) {
      scene_.warnings.push_back(path_.string() + ": " + warning);
    }
    for (std::size_t s = 0; s < model_.surfaces.size(); ++s) {
      const EnergyPlusSurface& surface = model_.surfaces[s];
      scene_.surfaces.push_back({.name = surface.name, .material = find_material(surface)});
      if (surface.base >= 0) windows_[static_cast<std::size_t>(surface.base)].push_back(s);
    }
    for (std::size_t s = 0; s < model_.surfaces.size(); ++s) add_surface(s);
    return {std::move(scene_), {}};
  }

 private:
  [[noreturn]] void fail_at(std::size_t s, const std::string& what) const {
    fail(path_, fmt::format("surface \"{}\" {}", model_.surfaces[s].name, what));
  }

  int find_material(const EnergyPlusSurface& surface) {
    const auto [entry, is_new] =
        materials_.try_emplace(surface.material, static_cast<int>(scene_.materials.size()));
    if (is_new) {
      scene_.materials.push_back(
          {.name = surface.material,
           .reflectance = Eigen::VectorXd::Constant(1, 1 - surface.emissivity),
           .emission = {}});
    }
    return entry->second;
  }

  void add_surface(std::size_t s) {
    const auto& corners = model_.surfaces[s].corners;
    if (windows_[s].empty()) return add_polygon(corners, s);
    const Vec3 normal = radiosity::vector_area(corners).normalized();
    if (!normal.allFinite()) fail_at(s, "has no area");
    std::vector<ConvexPolygon> holes;
    for (const std::size_t window : windows_[s]) {
      for (const ConvexPolygon& part : hole_of(window, s, normal)) holes.push_back(part);
    }
    double windows_area = 0;
    for (const ConvexPolygon& hole : holes) windows_area += area_of(hole.points());
    const double thickness = 1e-6 * radiosity::bounding_disc(corners).radius;
    double left = 0;
    for (const ConvexPolygon& part : convex_parts(corners, normal, s)) {
      for (const ConvexPolygon& piece : flat_difference(part, holes, normal, thickness)) {
        left += area_of(piece.points());
        add_polygon({piece.begin(), piece.end()}, s);
      }
    }
    if (std::abs(area_of(corners) - windows_area - left) > kOffWall * windows_area) {
      fail_at(s, fmt::format("has {:.6g} m² of windows, of which {:.6g} m² lie in it: they reach "
                             "beyond it, or overlap",
                             windows_area, area_of(corners) - left));
    }
    if (left == 0) fail_at(s, "is nothing but windows; expected some wall around them");
  }

  std::vector<ConvexPolygon> convex_parts(const std::vector<Vec3>& corners, const Vec3& normal,
                                          std::size_t s) const {
    if (is_convex(corners, normal)) return {ConvexPolygon(corners)};
    const meshing::PlaneFrame frame(corners);
    std::vector<meshing::Vec2> flat;
    for (const Vec3& corner : corners) flat.push_back(frame.to_plane(corner));
    const auto triangles = meshing::clip_ears(flat);
    if (!triangles) fail_at(s, "has an outline that crosses itself");
    std::vector<ConvexPolygon> parts;
    for (const meshing::Triangle& triangle : *triangles) {
      ConvexPolygon part;
      for (const std::int32_t k : triangle) part.push_back(corners[static_cast<std::size_t>(k)]);
      parts.push_back(part);
    }
    return parts;
  }

  /// The window as its wall turns.
  std::vector<ConvexPolygon> hole_of(std::size_t window, std::size_t wall,
                                     const Vec3& normal) const {
    std::vector<Vec3> corners = model_.surfaces[window].corners;
    const Vec3& on_wall = model_.surfaces[wall].corners.front();
    const double within = kOffWall * radiosity::bounding_disc(corners).radius;
    for (const Vec3& corner : corners) {
      if (std::abs(normal.dot(corner - on_wall)) <= within) continue;
      fail_at(window,
              fmt::format("does not lie in the plane of \"{}\"", model_.surfaces[wall].name));
    }
    if (radiosity::vector_area(corners).dot(normal) <= 0) {
      fail_at(window, fmt::format("faces the other way than \"{}\" that it is in",
                                  model_.surfaces[wall].name));
    }
    return convex_parts(corners, normal, window);
  }

  void add_polygon(const std::vector<Vec3>& corners, std::size_t s) {
    std::vector<std::int32_t> indices;
    for (const Vec3& corner : corners) {
      indices.push_back(static_cast<std::int32_t>(scene_.vertices.size()));
      scene_.vertices.push_back(corner);
    }
    scene_.add_polygon(indices, static_cast<std::int32_t>(s));
  }

  const std::filesystem::path& path_;
  const EnergyPlusModel& model_;
  std::vector<std::vector<std::size_t>> windows_;  // in each surface
  std::map<std::string, int> materials_;
  Scene scene_;
};

}  // namespace

FileScene read_energyplus(const std::filesystem::path& path, const radiosity::Progress& progress) {
  const EnergyPlusModel model = read_energyplus_model(path, progress);
  if (model.surfaces.empty()) fail(path, "has no surfaces");
  return EnergyPlusScene(path, model).run();
}

}  // namespace io
