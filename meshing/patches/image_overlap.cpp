#include "meshing/patches/image_overlap.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "meshing/base/text.h"
#include "radiosity/base/box_tree.h"
#include "radiosity/base/error.h"
#include "radiosity/base/parallel.h"
#include "radiosity/polygon/convex_polygon.h"

namespace meshing {
namespace {

using namespace radiosity;

/// Distances, in thicknesses, up to which polygons touch: images are rounded, too.
constexpr double kTouch = 10;
/// Share of a polygon's area that may be covered by rounding.
constexpr double kNoCover = 1e-6;

struct Span {
  double low = 1e300;
  double high = -1e300;
  void extend(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
};

struct Facet {
  ConvexPolygon corners;
  Vec3 normal;

  [[nodiscard]] double height(const Vec3& x) const { return normal.dot(x - corners[0]); }
  [[nodiscard]] Span heights(const Facet& other) const {
    Span span;
    for (const Vec3& corner : other.corners) span.extend(height(corner));
    return span;
  }
};

Facet facet(const PatchMesh& mesh, Index i) {
  Facet result{{}, mesh.normal[i]};
  for (int k = 0; k < mesh.n_corners(i); ++k) result.corners.push_back(mesh.corner(i, k));
  return result;
}

Facet moved(const Facet& facet, const Motion& motion) {
  Facet result{{}, motion.linear * facet.normal};
  const auto n = facet.corners.size();
  for (std::size_t k = 0; k < n; ++k) {
    result.corners.push_back(motion(facet.corners[motion.is_mirrored() ? n - 1 - k : k]));
  }
  return result;
}

bool covers(const Facet& a, const Facet& b, double touch) {
  ConvexPolygon rest = b.corners;
  const auto n = a.corners.size();
  for (std::size_t k = 0; k < n && rest.size() >= 3; ++k) {
    const Vec3& start = a.corners[k];
    const Vec3 inwards = a.normal.cross(a.corners[(k + 1) % n] - start).normalized();
    rest = clip_to_half_space(rest.points(), start, inwards, touch);
  }
  if (rest.size() < 3) return false;
  return vector_area(rest.points()).norm() > kNoCover * vector_area(b.corners.points()).norm();
}

/// Where the plane of `other` cuts a facet, along a direction.
Span cut(const Facet& facet, const Facet& other, const Vec3& along) {
  Span span;
  const auto n = facet.corners.size();
  for (std::size_t k = 0; k < n; ++k) {
    const Vec3& a = facet.corners[k];
    const Vec3& b = facet.corners[(k + 1) % n];
    const double from = other.height(a);
    const double to = other.height(b);
    if ((from < 0) == (to < 0)) continue;
    span.extend(along.dot(a + from / (from - to) * (b - a)));
  }
  return span;
}

/// Whether two facets pass through each other, or lie on each other and face the same way.
bool overlap(const Facet& a, const Facet& b, double touch) {
  const Span b_above = a.heights(b);
  if (b_above.low > touch || b_above.high < -touch) return false;
  if (b_above.low >= -touch && b_above.high <= touch) {
    return a.normal.dot(b.normal) > 0 && covers(a, b, touch);
  }
  const Span a_above = b.heights(a);
  const bool is_through =
      b_above.low < -touch && b_above.high > touch && a_above.low < -touch && a_above.high > touch;
  if (!is_through) return false;
  const Vec3 along = a.normal.cross(b.normal).normalized();
  const Span in_a = cut(a, b, along);
  const Span in_b = cut(b, a, along);
  return std::min(in_a.high, in_b.high) - std::max(in_a.low, in_b.low) > touch;
}

void refuse_cut_polygons(const Scene& scene, double touch) {
  for (const Symmetry::Mirror& mirror : scene.symmetry.mirrors) {
    for (Index i = 0; i < scene.n_polygons(); ++i) {
      Span heights;
      for (const std::int32_t vertex : scene.polygon(i)) {
        heights.extend(mirror.normal.dot(scene.vertices[vertex] - mirror.point));
      }
      if (heights.low >= -touch || heights.high <= touch) continue;
      throw MeshError(source_prefix(scene) + polygon_name(scene, i) + ": a mirror plane, through " +
                      place(mirror.point) + ", cuts it, with corners " + number(-heights.low) +
                      " m and " + number(heights.high) +
                      " m to either side; expected polygons that end there");
    }
  }
}

}  // namespace

void refuse_overlapping_images(const Scene& scene, const PatchMesh& mesh) {
  const double touch = kTouch * plane_thickness(mesh);
  refuse_cut_polygons(scene, touch);
  std::vector<Box3> boxes;
  std::vector<Facet> facets;
  for (Index i = 0; i < mesh.size(); ++i) {
    boxes.push_back(grown(patch_box(mesh, i), touch));
    facets.push_back(facet(mesh, i));
  }
  const BoxTree tree(boxes);
  std::vector<std::optional<std::pair<std::int32_t, std::int32_t>>> found(mesh.images.size());
  parallel_for(static_cast<std::ptrdiff_t>(mesh.images.size()), [&](std::ptrdiff_t g) {
    for (std::int32_t j = 0; j < mesh.size() && !found[g]; ++j) {
      const Facet image = moved(facets[j], mesh.images[g]);
      Box3 box;
      for (const Vec3& corner : image.corners) box.extend(corner);
      tree.for_each_meeting(box, [&](std::int32_t i) {
        if (!found[g] && overlap(facets[i], image, touch)) found[g] = {i, j};
      });
    }
  });
  for (const auto& pair : found) {
    if (!pair) continue;
    const auto [i, j] = *pair;
    throw MeshError(source_prefix(scene) + polygon_name(scene, mesh.polygon[i]) +
                    ": overlaps an image of " + polygon_name(scene, mesh.polygon[j]) +
                    "; expected a part whose images lie side by side");
  }
}

}  // namespace meshing
