#include "radiosity/picture/shooting_sources.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <span>

#include "radiosity/base/median_split.h"

namespace radiosity {
namespace {

using Set = std::span<std::int32_t>;

/// Surface, brightness, and the plane to a millionth of the scene's size.
using PlaneKey = std::array<std::int64_t, 6>;

class SourceDivider {
 public:
  explicit SourceDivider(const PatchMesh& mesh) : mesh_(mesh) {}

  void divide(Set set, Index largest) {
    if (static_cast<Index>(set.size()) > largest) {
      for (const Set half : halved(set)) divide(half, largest);
      return;
    }
    const auto root = static_cast<std::int32_t>(result_.nodes.size());
    add_nodes(set);
    ShootingSources::Group group{root, {set.begin(), set.end()}, {}};
    spread(root, group.points);
    result_.groups.push_back(std::move(group));
  }

  ShootingSources take() { return std::move(result_); }

 private:
  /// The halves along the longest side of the patches' box.
  [[nodiscard]] std::array<Set, 2> halved(Set set) const {
    Box3 box;
    for (const std::int32_t i : set) box.extend(mesh_.centroid[i]);
    int axis = 0;
    box.sizes().maxCoeff(&axis);
    return split_at_median(set, [&](std::int32_t i) { return mesh_.centroid[i][axis]; });
  }

  void add_nodes(Set set) {
    const std::size_t self = result_.nodes.size();
    ShootingSources::Node node;
    node.center = Vec3::Zero();
    for (const std::int32_t i : set) {
      node.area += mesh_.area[i];
      node.center += mesh_.area[i] * mesh_.centroid[i];
    }
    node.center /= node.area;
    for (const std::int32_t i : set) {
      for (int k = 0; k < mesh_.n_corners(i); ++k) {
        node.radius = std::max(node.radius, (mesh_.corner(i, k) - node.center).norm());
      }
    }
    if (set.size() == 1) node.patch = set.front();
    result_.nodes.push_back(node);
    if (set.size() > 1) {
      for (const Set half : halved(set)) add_nodes(half);
    }
    result_.nodes[self].end = static_cast<std::int32_t>(result_.nodes.size());
  }

  /// So many points on patches of a node.
  void spread(std::int32_t index, std::span<Vec3> points) const {
    const ShootingSources::Node& node = result_.nodes[index];
    if (points.size() == 1) {
      points[0] = mesh_.centroid[central_patch(index)];
      return;
    }
    if (node.patch < 0) {
      const std::int32_t second = result_.nodes[index + 1].end;
      const std::size_t half = points.size() / 2;
      spread(index + 1, points.first(half));
      spread(second, points.subspan(half));
      return;
    }
    for (std::size_t k = 0; k < points.size(); ++k) {
      points[k] = inner_point(mesh_, node.patch, static_cast<int>(k));
    }
  }

  /// The patch of a node that is closest to its centre.
  [[nodiscard]] std::int32_t central_patch(std::int32_t index) const {
    const ShootingSources::Node& node = result_.nodes[index];
    std::int32_t best = index;
    double least = std::numeric_limits<double>::infinity();
    for (std::int32_t k = index; k < node.end; ++k) {
      const ShootingSources::Node& part = result_.nodes[k];
      if (part.patch < 0) continue;
      const double distance = (part.center - node.center).squaredNorm();
      if (distance < least) {
        least = distance;
        best = k;
      }
    }
    return result_.nodes[best].patch;
  }

  const PatchMesh& mesh_;
  ShootingSources result_;
};

}  // namespace

Vec3 inner_point(const PatchMesh& mesh, std::int32_t patch, int k) {
  const Vec3& centroid = mesh.centroid[patch];
  return k < mesh.n_corners(patch) ? Vec3(0.5 * (centroid + mesh.corner(patch, k))) : centroid;
}

ShootingSources make_shooting_sources(const PatchMesh& mesh, const std::vector<bool>& is_bright,
                                      Index largest) {
  constexpr double kSteps = 1e6;
  const Box3 box = bounds(mesh);
  const double scale = box.isEmpty() ? 1 : kSteps / box.diagonal().norm();
  std::map<PlaneKey, std::vector<std::int32_t>> planes;
  for (std::int32_t i = 0; i < mesh.size(); ++i) {
    const Vec3& normal = mesh.normal[i];
    const double offset = normal.dot(mesh.centroid[i] - box.center());
    planes[{mesh.surface[i], is_bright[i] ? 1 : 0, std::llround(kSteps * normal.x()),
            std::llround(kSteps * normal.y()), std::llround(kSteps * normal.z()),
            std::llround(scale * offset)}]
        .push_back(i);
  }
  SourceDivider divider(mesh);
  for (auto& [key, patches] : planes) {
    const bool is_light = key[1] != 0;
    divider.divide(patches, std::max<Index>(1, is_light ? largest / 4 : largest));
  }
  return divider.take();
}

}  // namespace radiosity
