#include "radiosity/visibility/visible_polygon.h"

#include <algorithm>
#include <array>

#include "radiosity/polygon/point_to_polygon.h"

namespace radiosity {
namespace {

/// Polygons with this many corners are halved, since each further cut may add one.
constexpr std::size_t kMostCornersUncut = 9;

/// A polygon cut from corner to corner.
std::array<ConvexPolygon, 2> halves(const ConvexPolygon& polygon) {
  const std::size_t half = polygon.size() / 2;
  std::array<ConvexPolygon, 2> result;
  for (std::size_t k = 0; k <= half; ++k) result[0].push_back(polygon[k]);
  for (std::size_t k = half; k < polygon.size(); ++k) result[1].push_back(polygon[k]);
  result[1].push_back(polygon[0]);
  return result;
}

/// Appends a polygon, in halves if further cuts might exceed its capacity.
void add_part(const ConvexPolygon& part, std::vector<ConvexPolygon>& parts) {
  if (part.size() < 3) return;
  if (part.size() < kMostCornersUncut) {
    parts.push_back(part);
    return;
  }
  for (const ConvexPolygon& half : halves(part)) parts.push_back(half);
}

/// A half-space of a shadow as a point throws it: the shadow is where inwards · (x - on_plane) > 0.
struct Border {
  Vec3 inwards;
  Vec3 on_plane;
};

std::size_t n_borders(const Shadow& shadow) { return shadow.edges.size() + shadow.faces.size(); }

Border border(const Shadow& shadow, std::size_t k, const Vec3& point) {
  if (k < shadow.edges.size()) {
    const Shadow::Edge& edge = shadow.edges[k];
    return {(edge.end - point).cross(edge.start - point), point};
  }
  const HalfSpace& face = shadow.faces[k - shadow.edges.size()];
  return {-face.normal, face.normal * face.offset};
}

/// The part of a polygon within the shadow that the point throws.
ConvexPolygon shadowed(const ConvexPolygon& polygon, const Shadow& shadow, const Vec3& point) {
  ConvexPolygon rest = polygon;
  for (std::size_t k = 0; k < n_borders(shadow); ++k) {
    const Border limit = border(shadow, k, point);
    if (!keep_above(limit.on_plane, limit.inwards, rest)) break;
  }
  return rest;
}

/// Whether a border of the shadow that the point throws has the whole polygon outside.
bool misses(const ConvexPolygon& polygon, const Shadow& shadow, const Vec3& point) {
  for (std::size_t k = 0; k < n_borders(shadow); ++k) {
    const Border limit = border(shadow, k, point);
    const bool is_outside = std::all_of(polygon.begin(), polygon.end(), [&](const Vec3& corner) {
      return limit.inwards.dot(corner - limit.on_plane) <= 0;
    });
    if (is_outside) return true;
  }
  return false;
}

/// Appends the parts of `part` outside the shadow that the point sees to `parts`, given that none
/// of the shadow's borders before the first does anything to it.
void cut(const ConvexPolygon& part, const Shadow& shadow, const Vec3& point,
         std::vector<ConvexPolygon>& parts, std::size_t first_border = 0) {
  if (misses(part, shadow, point)) {
    add_part(part, parts);
    return;
  }
  ConvexPolygon rest = part;
  ConvexPolygon inside;
  ConvexPolygon outside;
  const std::size_t first = parts.size();
  for (std::size_t k = first_border; k < n_borders(shadow); ++k) {
    if (rest.size() + 1 >= ConvexPolygon::kCapacity) {
      for (const ConvexPolygon& half : halves(rest)) cut(half, shadow, point, parts, k);
      return;
    }
    const Border limit = border(shadow, k, point);
    if (split(rest, limit.on_plane, limit.inwards, 0, inside, outside)) {
      add_part(outside, parts);
      rest = inside;
    } else if (inside.empty()) {  // the shadow misses the part
      parts.resize(first);
      add_part(part, parts);
      return;
    }
  }
}

}  // namespace

Shadow shadow_of(const Occluder& occluder, const Vec3& point, double thickness) {
  Shadow shadow;
  const double height = occluder.normal.dot(point) - occluder.offset;
  if (std::abs(height) <= thickness) return shadow;  // seen edge-on it hides nothing
  const double side = height > 0 ? 1 : -1;
  shadow.faces.push_back({side * occluder.normal, side * occluder.offset});
  for (std::size_t k = 0; k < occluder.corners.size(); ++k) {
    const Vec3& a = occluder.corners[k];
    const Vec3& b = occluder.corners[k + 1 < occluder.corners.size() ? k + 1 : 0];
    shadow.edges.push_back(height > 0 ? Shadow::Edge{a, b} : Shadow::Edge{b, a});
  }
  return shadow;
}

std::span<const ConvexPolygon> ShadowCutter::visible_parts(const Vec3& point,
                                                           const ConvexPolygon& target,
                                                           std::span<const Shadow> shadows) {
  parts_.assign(1, target);
  for (const Shadow& shadow : shadows) {
    if (n_borders(shadow) == 0) continue;
    next_parts_.clear();
    for (const ConvexPolygon& part : parts_) cut(part, shadow, point, next_parts_);
    parts_.swap(next_parts_);
    if (parts_.empty()) break;
  }
  return parts_;
}

double ShadowCutter::visible_part(const Vec3& point, const Vec3& normal,
                                  const ConvexPolygon& target, double whole,
                                  std::span<const Shadow> shadows) {
  if (shadows.empty()) return whole;
  if (shadows.size() == 1 && n_borders(shadows[0]) == 0) return whole;
  if (shadows.size() == 1 && n_borders(shadows[0]) + target.size() < ConvexPolygon::kCapacity) {
    const ConvexPolygon hidden = shadowed(target, shadows[0], point);
    if (hidden.empty()) return whole;
    // Hidden in full, the difference is rounding, of either sign.
    return std::max(0.0, whole - facing_point_to_polygon(point, normal, hidden.points()));
  }
  double sum = 0;
  for (const ConvexPolygon& part : visible_parts(point, target, shadows)) {
    sum += facing_point_to_polygon(point, normal, part.points());
  }
  return sum;
}

double visible_point_to_polygon(const Vec3& point, const Vec3& normal, const ConvexPolygon& target,
                                std::span<const Occluder* const> occluders, double thickness) {
  std::vector<Shadow> shadows;
  for (const Occluder* occluder : occluders) {
    shadows.push_back(shadow_of(*occluder, point, thickness));
  }
  const double whole = facing_point_to_polygon(point, normal, target.points());
  return ShadowCutter().visible_part(point, normal, target, whole, shadows);
}

}  // namespace radiosity
