#include "radiosity/visibility/partial_sky.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "radiosity/polygon/spherical_integral.h"

namespace radiosity {
namespace {

/// Of an open sky, what quadrature over panes may leave per sr.
constexpr double kOfPanes = 1e-5;

/// What panes let through, as one band.
std::vector<Glazing> one_band(const Scene& scene, const Eigen::VectorXd& weights) {
  std::vector<Glazing> result;
  for (const Material& material : scene.materials) {
    Glazing glazing = material.glazing.value_or(Glazing{});
    if (material.glazing) {
      const double mean = weights.dot(glazing.transmittance) / weights.sum();
      glazing.transmittance = Eigen::VectorXd::Constant(1, mean);
    }
    result.push_back(glazing);
  }
  return result;
}

}  // namespace

PartialSky::Cap PartialSky::cap_about(const ConvexPolygon& part) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& corner : part) sum += corner.normalized();
  const Vec3 middle = sum.normalized();
  double radius = 0;
  for (const Vec3& corner : part) {
    radius = std::max(radius, std::acos(std::clamp(middle.dot(corner.normalized()), -1., 1.)));
  }
  return {middle, radius};
}

PartialSky::PartialSky(const Scene& scene, const PatchMesh& mesh, std::vector<ConvexPolygon> parts,
                       const Eigen::VectorXd& weights)
    : up_(scene.sky->up),
      parts_(std::move(parts)),
      glazings_(one_band(scene, weights)),
      cells_(octants(up_)),
      visible_(mesh, panes_of(scene, mesh)) {
  for (const ConvexPolygon& part : parts_) caps_.push_back(cap_about(part));
}

double PartialSky::through(std::span<const VisibleSky::Pane> panes, const Vec3& direction) const {
  double factor = 1;
  for (const VisibleSky::Pane& pane : panes) {
    factor *= glazings_[pane.kind].at(pane.normal.dot(direction), 0);
  }
  return factor;
}

double PartialSky::section(const ConvexPolygon& part, std::span<const VisibleSky::Pane> panes,
                           const Vec3& normal) const {
  if (panes.empty()) return projected_solid_angle(part, normal);
  // On the horizon a cosine may be below 0 by rounding.
  const double value = spherical_integral(part.points(), kOfPanes, [&](const Vec3& direction) {
                         return normal.dot(direction) * through(panes, direction);
                       }).value;
  return std::max(0., value);
}

void PartialSky::add(const Vec3& point, const Vec3& normal, double factor,
                     Eigen::Ref<Eigen::VectorXd> sums) const {
  const auto n = static_cast<Index>(parts_.size());
  visible_.visit(point, normal, cells_, [&](const ConvexPolygon& seen, auto panes) {
    const Cap cap = cap_about(seen);
    if (up_.dot(cap.middle) < 0) {
      sums[n] += factor * section(seen, panes, normal);
      return;
    }
    for (Index k = 0; k < n; ++k) {
      const double reach = cap.radius + caps_[k].radius;
      if (cap.middle.dot(caps_[k].middle) < std::cos(std::min(reach, kPi))) continue;
      ConvexPolygon common = seen;
      const ConvexPolygon& part = parts_[k];
      bool is_any = true;
      for (std::size_t e = 0; e < part.size() && is_any; ++e) {
        const Vec3 inwards = part[e].cross(part[e + 1 < part.size() ? e + 1 : 0]);
        is_any = keep_above(Vec3::Zero(), inwards, common);
      }
      if (is_any && common.size() >= 3) sums[k] += factor * section(common, panes, normal);
    }
  });
}

void PartialSky::visit_beams(const Vec3& point, const Vec3& normal,
                             std::span<const Vec3> directions,
                             const std::function<void(std::size_t, double)>& visit) const {
  visible_.visit_directions(point, normal, directions, [&](std::size_t k, auto panes) {
    visit(k, normal.dot(directions[k]) * through(panes, directions[k]));
  });
}

}  // namespace radiosity
