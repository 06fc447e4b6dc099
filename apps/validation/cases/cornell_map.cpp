#include "apps/validation/cases/cornell_map.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace apps::validation {
namespace {

using radiosity::Vec3;

/// Two directions in the plane of a polygon: to the right and up, as seen from its front.
struct PageAxes {
  Vec3 right = Vec3::UnitX();
  Vec3 up = Vec3::UnitY();
};

PageAxes page_axes(const std::vector<Vec3>& corners) {
  const Vec3 normal = radiosity::vector_area(corners).normalized();
  const bool is_level = std::abs(normal.y()) > 0.9;  // the box stands on y = 0
  const Vec3 about_up = is_level ? Vec3::UnitZ() : Vec3::UnitY();
  const Vec3 up = (about_up - about_up.dot(normal) * normal).normalized();
  return {up.cross(normal), up};
}

/// Relative difference, bands added up; 0 where both are dark.
double relative_difference(const ReferencePolygon& expected, const Eigen::RowVectorXd& computed) {
  const double sum = expected.radiosity.sum();
  const double difference = computed.sum() - sum;
  return difference == 0 ? 0 : difference / sum;
}

/// Index of the surface's panel, made if it is not there.
std::size_t panel_of(SurfaceMap& map, const std::string& surface) {
  const auto found = std::find_if(map.panels.begin(), map.panels.end(),
                                  [&](const MapPanel& panel) { return panel.label == surface; });
  if (found == map.panels.end()) {
    map.panels.push_back({surface, {}});
    return map.panels.size() - 1;
  }
  return found - map.panels.begin();
}

}  // namespace

SurfaceMap difference_map(const std::vector<ReferencePolygon>& reference,
                          const Eigen::MatrixXd& computed,
                          const std::vector<std::size_t>& left_out) {
  constexpr double kMetre = 1e-3;
  SurfaceMap map{"Where it differs: each surface as seen from its front",
                 "(ours - reference) / reference, bands added up",
                 0.05,
                 {}};
  std::vector<PageAxes> axes;  // per panel: of its first polygon
  for (std::size_t i = 0; i < reference.size(); ++i) {
    const ReferencePolygon& polygon = reference[i];
    const std::size_t p = panel_of(map, polygon.surface);
    if (p == axes.size()) axes.push_back(page_axes(polygon.corners));
    MapPolygon drawn;
    for (const Vec3& corner : polygon.corners) {
      drawn.corners.emplace_back(kMetre * axes[p].right.dot(corner),
                                 kMetre * axes[p].up.dot(corner));
    }
    const bool is_compared = polygon.surface != "light" &&
                             std::find(left_out.begin(), left_out.end(), i) == left_out.end();
    if (is_compared) {
      drawn.value = relative_difference(polygon, computed.row(static_cast<Eigen::Index>(i)));
    }
    map.panels[p].polygons.push_back(std::move(drawn));
  }
  return map;
}

}  // namespace apps::validation
