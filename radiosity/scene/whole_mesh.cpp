#include "radiosity/scene/whole_mesh.h"

#include <algorithm>
#include <utility>

namespace radiosity {
namespace {

void add_image(const PatchMesh& part, const Motion& motion, PatchMesh& whole) {
  const auto first_patch = static_cast<std::int32_t>(whole.size());
  const auto first_vertex = static_cast<std::int32_t>(whole.vertices.size());
  const auto first_polygon = static_cast<std::int32_t>(whole.n_polygons());
  const auto first_family = static_cast<std::int32_t>(
      part.family.empty() ? 0
                          : whole.size() / part.size() *
                                (*std::max_element(part.family.begin(), part.family.end()) + 1));
  const auto after = [](std::int32_t first, std::int32_t number) {
    return number < 0 ? number : first + number;
  };
  for (const Vec3& vertex : part.vertices) whole.vertices.push_back(motion(vertex));
  for (Index i = 0; i < part.size(); ++i) {
    std::array<std::int32_t, 4> corners = part.corners[i];
    for (std::int32_t& corner : corners) corner = after(first_vertex, corner);
    // Counter-clockwise again.
    if (motion.is_mirrored()) std::swap(corners[1], corners[part.n_corners(i) - 1]);
    whole.add_patch(corners, part.surface[i], after(first_polygon, part.polygon[i]),
                    after(first_patch, part.twin[i]));
    whole.family.back() = after(first_family, part.family[i]);
    // To the last bit, although corners come in another order.
    whole.area.back() = part.area[i];
    whole.normal.back() = motion.linear * part.normal[i];
    whole.centroid.back() = motion(part.centroid[i]);
  }
  for (Index k = 0; k < part.n_polygons(); ++k) {
    for (const Vec3& corner : part.outline(k)) whole.polygon_corners.push_back(motion(corner));
    const auto begin = whole.polygon_corners.end() - part.outline(k).size();
    if (motion.is_mirrored()) std::reverse(begin + 1, whole.polygon_corners.end());
    whole.first_polygon_corner.push_back(static_cast<std::int64_t>(whole.polygon_corners.size()));
  }
}

}  // namespace

PatchMesh make_whole(const PatchMesh& part) {
  PatchMesh whole = part;
  whole.images = {};
  const Index n_parts = static_cast<Index>(part.images.size()) + 1;
  whole.reserve(n_parts * part.size());
  whole.vertices.reserve(n_parts * part.vertices.size());
  for (const Motion& motion : part.images) add_image(part, motion, whole);
  return whole;
}

}  // namespace radiosity
