#include "radiosity/visibility/visible_sky.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "radiosity/polygon/point_to_polygon.h"
#include "radiosity/visibility/visible_polygon.h"

namespace radiosity {
namespace {

/// A cell with no more surfaces in it is not divided: they are cut out of it.
constexpr std::size_t kFewSurfaces = 6;
/// Nor is one that has been halved so often: what it holds are silhouettes.
constexpr int kMostHalvings = 14;
/// Nor one with more corners, of which cutting makes yet more.
constexpr std::size_t kMostCorners = 9;

/// A side shorter than this, rad, has a plane that rounding may turn any way; of longer ones the
/// plane is off by 1e-8 rad at most.
constexpr double kShortSide = 1e-8;

/// The polygon in quads and triangles from corner to corner: cutting along them adds few corners.
std::vector<Occluder> in_quads(const Occluder& occluder) {
  const std::vector<Vec3>& corners = occluder.corners;
  std::vector<Occluder> result;
  for (std::size_t k = 1; k + 1 < corners.size(); k += 2) {
    Occluder part{{corners[0], corners[k], corners[k + 1]}, occluder.normal, occluder.offset, {}};
    if (k + 2 < corners.size()) part.corners.push_back(corners[k + 2]);
    result.push_back(std::move(part));
  }
  return result;
}

/// Whether the side between two corners is long enough, its plane's normal being their product.
bool tells_plane(const Vec3& product, const Vec3& start, const Vec3& end) {
  return product.squaredNorm() > kShortSide * kShortSide * start.squaredNorm() * end.squaredNorm();
}

/// A convex polygon as the point sees it: the planes through its edges and the point, with the
/// polygon in front of them.
struct SeenSurface {
  std::vector<Vec3> corners;  // relative to the point, counter-clockwise from behind the polygon
  std::vector<Vec3> inwards;
  std::vector<Vec3> sides;  // those of `inwards` that tell a plane
  double size = 0;          // roughly its solid angle

  SeenSurface(const Occluder& occluder, const Vec3& point, bool from_front) {
    for (const Vec3& corner : occluder.corners) corners.push_back(corner - point);
    if (from_front) std::reverse(corners.begin(), corners.end());
    Vec3 middle = Vec3::Zero();
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const Vec3& end = corners[k + 1 < corners.size() ? k + 1 : 0];
      inwards.push_back(corners[k].cross(end));
      if (tells_plane(inwards.back(), corners[k], end)) sides.push_back(inwards.back());
      middle += corners[k];
    }
    middle /= static_cast<double>(corners.size());
    const double distance = middle.norm();
    size = distance > 0
               ? std::abs(vector_area(corners).dot(middle)) / (distance * distance * distance)
               : 0;
  }

  [[nodiscard]] bool holds(const Vec3& direction) const {
    return std::all_of(inwards.begin(), inwards.end(),
                       [&](const Vec3& inward) { return inward.dot(direction) >= 0; });
  }

  [[nodiscard]] Shadow shadow() const {
    Shadow result;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      result.edges.push_back({corners[k + 1 < corners.size() ? k + 1 : 0], corners[k]});
    }
    return result;
  }
};

/// Whether all points lie behind the plane through the origin, or in it.
bool are_behind(const Vec3& inwards, std::span<const Vec3> points) {
  return std::all_of(points.begin(), points.end(),
                     [&](const Vec3& x) { return inwards.dot(x) <= 0; });
}

bool are_in_front(const Vec3& inwards, std::span<const Vec3> points) {
  return std::all_of(points.begin(), points.end(),
                     [&](const Vec3& x) { return inwards.dot(x) >= 0; });
}

/// The normals, inwards, of a cell's sides but for those that cutting has left too short to tell a
/// plane by.
ConvexPolygon sides_of(const ConvexPolygon& cell) {
  ConvexPolygon sides;
  for (std::size_t k = 0; k < cell.size(); ++k) {
    const Vec3& end = cell[k + 1 < cell.size() ? k + 1 : 0];
    const Vec3 inwards = cell[k].cross(end);
    if (tells_plane(inwards, cell[k], end)) sides.push_back(inwards);
  }
  return sides;
}

/// Whether the surface is proved to be out of the cell with these sides.
bool misses_cell(const SeenSurface& surface, const ConvexPolygon& cell,
                 const ConvexPolygon& sides) {
  return std::any_of(surface.sides.begin(), surface.sides.end(),
                     [&](const Vec3& inwards) { return are_behind(inwards, cell.points()); }) ||
         std::any_of(sides.begin(), sides.end(),
                     [&](const Vec3& inwards) { return are_behind(inwards, surface.corners); });
}

bool fills_cell(const SeenSurface& surface, const ConvexPolygon& cell) {
  return std::all_of(surface.inwards.begin(), surface.inwards.end(),
                     [&](const Vec3& inwards) { return are_in_front(inwards, cell.points()); });
}

/// The normal of the plane in the middle between the two corners that are furthest apart.
Vec3 across_longest(const ConvexPolygon& cell) {
  Vec3 result = Vec3::Zero();
  double longest = -1;
  for (std::size_t i = 0; i < cell.size(); ++i) {
    for (std::size_t k = i + 1; k < cell.size(); ++k) {
      const Vec3 between = cell[i].normalized() - cell[k].normalized();
      if (between.squaredNorm() <= longest) continue;
      longest = between.squaredNorm();
      result = between;
    }
  }
  return result;
}

/// All that one point sees, and the walk through the cells.
class SkyView {
 public:
  SkyView(const VisibleSky::Visit& visit) : visit_(visit) {}

  void add_surface(const Occluder& occluder, const Vec3& point, const Vec3& normal,
                   double thickness) {
    if (const auto side = side_seen(occluder, point, normal, thickness)) {
      surfaces_.emplace_back(occluder, point, side > 0);
    }
  }
  void add_pane(const Occluder& occluder, int kind, const Vec3& point, const Vec3& normal,
                double thickness) {
    if (const auto side = side_seen(occluder, point, normal, thickness)) {
      panes_.emplace_back(occluder, point, side > 0);
      kinds_.push_back({kind, occluder.normal});
    }
  }

  [[nodiscard]] bool is_hidden(const Vec3& direction) const {
    return std::any_of(surfaces_.begin(), surfaces_.end(),
                       [&](const SeenSurface& surface) { return surface.holds(direction); });
  }
  [[nodiscard]] std::vector<VisibleSky::Pane> passed_by(const Vec3& direction) const {
    std::vector<VisibleSky::Pane> result;
    for (std::size_t k = 0; k < panes_.size(); ++k) {
      if (panes_[k].holds(direction)) result.push_back(kinds_[k]);
    }
    return result;
  }

  void start(const ConvexPolygon& cell) {
    std::vector<std::int32_t> all(surfaces_.size());
    for (std::size_t k = 0; k < all.size(); ++k) all[k] = static_cast<std::int32_t>(k);
    // Large ones first: one that fills a cell ends it.
    std::stable_sort(all.begin(), all.end(), [&](std::int32_t i, std::int32_t k) {
      return surfaces_[i].size > surfaces_[k].size;
    });
    walk(cell, all, 0);
  }

 private:
  /// 1 if its front is seen, -1 if its back is, 0 if it hides nothing above the element's horizon.
  static int side_seen(const Occluder& occluder, const Vec3& point, const Vec3& normal,
                       double thickness) {
    const double height = occluder.normal.dot(point) - occluder.offset;
    if (std::abs(height) <= thickness) return 0;
    const bool is_below =
        std::all_of(occluder.corners.begin(), occluder.corners.end(),
                    [&](const Vec3& corner) { return normal.dot(corner - point) <= 0; });
    if (is_below) return 0;
    return height > 0 ? 1 : -1;
  }

  void walk(const ConvexPolygon& cell, const std::vector<std::int32_t>& candidates, int halvings) {
    std::vector<std::int32_t> met;
    const ConvexPolygon sides = sides_of(cell);
    for (const std::int32_t k : candidates) {
      if (misses_cell(surfaces_[k], cell, sides)) continue;
      if (fills_cell(surfaces_[k], cell)) return;
      met.push_back(k);
    }
    if (met.size() <= kFewSurfaces || halvings >= kMostHalvings || cell.size() > kMostCorners) {
      cut_out(cell, met);
      return;
    }
    ConvexPolygon one;
    ConvexPolygon other;
    split(cell, Vec3::Zero(), across_longest(cell), 0, one, other);
    for (const ConvexPolygon* half : {&one, &other}) {
      if (half->size() >= 3) walk(*half, met, halvings + 1);
    }
  }

  void cut_out(const ConvexPolygon& cell, const std::vector<std::int32_t>& met) {
    shadows_.clear();
    for (const std::int32_t k : met) shadows_.push_back(surfaces_[k].shadow());
    const auto seen = cutter_.visible_parts(Vec3::Zero(), cell, shadows_);
    const std::vector<ConvexPolygon> parts(seen.begin(), seen.end());
    for (const ConvexPolygon& part : parts) pass_panes(part, 0);
  }

  /// Divides a part at the borders of panes from the first on.
  void pass_panes(const ConvexPolygon& part, std::size_t first) {
    const ConvexPolygon sides = sides_of(part);
    for (std::size_t k = first; k < panes_.size(); ++k) {
      if (misses_cell(panes_[k], part, sides)) continue;
      if (!fills_cell(panes_[k], part)) {
        const Shadow shadow = panes_[k].shadow();
        const auto seen = cutter_.visible_parts(Vec3::Zero(), part, std::span(&shadow, 1));
        const std::vector<ConvexPolygon> beside(seen.begin(), seen.end());
        for (const ConvexPolygon& rest : beside) pass_panes(rest, k + 1);
      }
      ConvexPolygon through = part;
      for (const Vec3& inwards : panes_[k].inwards) {
        if (!keep_above(Vec3::Zero(), inwards, through)) return;
      }
      passed_.push_back(kinds_[k]);
      pass_panes(through, k + 1);
      passed_.pop_back();
      return;
    }
    visit_(part, passed_);
  }

  const VisibleSky::Visit& visit_;
  std::vector<SeenSurface> surfaces_;
  std::vector<SeenSurface> panes_;
  std::vector<VisibleSky::Pane> kinds_;   // of the panes
  std::vector<VisibleSky::Pane> passed_;  // by the part under way
  std::vector<Shadow> shadows_;
  ShadowCutter cutter_;
};

}  // namespace

VisibleSky::VisibleSky(const PatchMesh& mesh, std::span<const int> pane)
    : center_(mesh.size() > 0 ? Vec3(bounds(mesh).center()) : Vec3(0, 0, 0)),
      thickness_(plane_thickness(mesh)) {
  const PatchMesh about_center = centered(mesh);
  occluders_ = occluders_of_kind(about_center, pane, -1, thickness_);
  const int most = pane.empty() ? -1 : *std::max_element(pane.begin(), pane.end());
  for (int kind = 0; kind <= most; ++kind) {
    for (const Occluder& occluder : occluders_of_kind(about_center, pane, kind, thickness_)) {
      for (Occluder& part : in_quads(occluder)) panes_.push_back({std::move(part), kind});
    }
  }
}

void VisibleSky::visit(const Vec3& point, const Vec3& normal, std::span<const ConvexPolygon> cells,
                       const Visit& visit) const {
  const Vec3 x = point - center_;
  SkyView view(visit);
  for (const Occluder& occluder : occluders_) view.add_surface(occluder, x, normal, thickness_);
  for (const Glass& pane : panes_) {
    view.add_pane(pane.occluder, pane.kind, x, normal, thickness_);
  }
  for (const ConvexPolygon& cell : cells) {
    const ConvexPolygon above = clip_to_half_space(cell.points(), Vec3::Zero(), normal, 0);
    if (above.size() >= 3) view.start(above);
  }
}

void VisibleSky::visit_directions(
    const Vec3& point, const Vec3& normal, std::span<const Vec3> directions,
    const std::function<void(std::size_t, std::span<const Pane>)>& visit) const {
  const Vec3 x = point - center_;
  const Visit none;
  SkyView view(none);
  for (const Occluder& occluder : occluders_) view.add_surface(occluder, x, normal, thickness_);
  for (const Glass& pane : panes_) {
    view.add_pane(pane.occluder, pane.kind, x, normal, thickness_);
  }
  for (std::size_t k = 0; k < directions.size(); ++k) {
    if (!(normal.dot(directions[k]) > 0) || view.is_hidden(directions[k])) continue;
    visit(k, view.passed_by(directions[k]));
  }
}

std::vector<ConvexPolygon> octants(const Vec3& up) {
  const Vec3 u = up.unitOrthogonal();
  const Vec3 v = up.cross(u);
  std::vector<ConvexPolygon> result;
  const std::array<Vec3, 4> around = {u, v, -u, -v};
  for (const double sign : {1., -1.}) {
    for (std::size_t k = 0; k < 4; ++k) {
      const Vec3& a = around[k];
      const Vec3& b = around[(k + 1) % 4];
      const std::array<Vec3, 3> corners = {sign > 0 ? a : b, sign > 0 ? b : a, sign * up};
      result.emplace_back(corners);
    }
  }
  return result;
}

double projected_solid_angle(const ConvexPolygon& directions, const Vec3& normal) {
  ConvexPolygon seen;  // counter-clockwise about the side that it turns to the point
  for (std::size_t k = directions.size(); k-- > 0;) seen.push_back(directions[k]);
  return kPi * facing_point_to_polygon(Vec3::Zero(), normal, seen.points());
}

std::vector<int> panes_of(const Scene& scene, const PatchMesh& mesh) {
  const bool any =
      std::any_of(scene.materials.begin(), scene.materials.end(),
                  [](const Material& material) { return material.glazing.has_value(); });
  if (!any) return {};
  std::vector<int> result(static_cast<std::size_t>(mesh.size()), -1);
  for (Index i = 0; i < mesh.size(); ++i) {
    const int material = scene.surfaces[mesh.surface[i]].material;
    if (material < 0 || !scene.materials[material].glazing) continue;
    result[static_cast<std::size_t>(i)] = material;
  }
  return result;
}

}  // namespace radiosity
