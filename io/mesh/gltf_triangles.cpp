#include "io/mesh/gltf_triangles.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace io {
namespace {

/// Corners of the triangles of a primitive, as indices of its vertices (glTF 2.0, 3.7.2.1).
class TriangleList {
 public:
  static constexpr std::int64_t kTriangles = 4;
  static constexpr std::int64_t kStrip = 5;
  static constexpr std::int64_t kFan = 6;

  static bool is_known(std::int64_t mode) { return mode >= kTriangles && mode <= kFan; }
  static std::int64_t size(std::int64_t mode, std::int64_t n_corners) {
    return mode == kTriangles ? n_corners / 3 : std::max<std::int64_t>(n_corners - 2, 0);
  }
  static std::array<std::int64_t, 3> corners(std::int64_t mode, std::int64_t i) {
    if (mode == kTriangles) return {3 * i, 3 * i + 1, 3 * i + 2};
    if (mode == kFan) return {i + 1, i + 2, 0};
    return {i, i + 1 + i % 2, i + 2 - i % 2};
  }
};

std::int64_t mode(const JsonItem& primitive) {
  const auto item = primitive.find("mode");
  return item ? gltf_integer(*item, 6) : TriangleList::kTriangles;
}

}  // namespace

bool has_gltf_triangles(const JsonItem& primitive) {
  return TriangleList::is_known(mode(primitive));
}

std::int64_t n_gltf_triangles(const JsonItem& primitive, std::int64_t n_corners) {
  return TriangleList::size(mode(primitive), n_corners);
}

std::vector<std::int32_t> gltf_triangles(GltfDocument& document, const JsonItem& primitive,
                                         std::int64_t n_vertices) {
  const std::int64_t drawn_as = mode(primitive);
  GltfValues indices;
  indices.count = n_vertices;
  const auto given = primitive.find("indices");
  if (given) {
    const JsonItem accessor = document.element("accessors", *given);
    indices = document.values(accessor, "SCALAR");
    for (const double index : indices.values) {
      if (!(index >= 0 && index < static_cast<double>(n_vertices))) {
        accessor.fail(fmt::format("a triangle uses vertex {}, but there are {}, counted from 0",
                                  index, n_vertices));
      }
    }
  }
  const std::int64_t n_triangles = TriangleList::size(drawn_as, indices.count);
  std::vector<std::int32_t> result;
  result.reserve(static_cast<std::size_t>(3 * n_triangles));
  for (std::int64_t i = 0; i < n_triangles; ++i) {
    std::array<std::int32_t, 3> triangle{};
    const auto corners = TriangleList::corners(drawn_as, i);
    for (std::size_t k = 0; k < 3; ++k) {
      triangle[k] = static_cast<std::int32_t>(given ? indices(corners[k], 0)
                                                    : static_cast<double>(corners[k]));
    }
    // Strips are joined by triangles without area, which are none.
    const bool is_joint =
        triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[2] == triangle[0];
    if (drawn_as == TriangleList::kStrip && is_joint) continue;
    result.insert(result.end(), triangle.begin(), triangle.end());
  }
  return result;
}

}  // namespace io
