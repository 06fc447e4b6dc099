#include "study/seen_body.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "radiosity/polygon/spherical_integral.h"

namespace study {
namespace {

using namespace radiosity;

/// Of f_p, which is 0.08 to 0.35: what integrals over it may be off, for each sr.
constexpr double kAllowed = 2e-5;

/// Cosine of the longest side that a triangle of directions may have, 7.5°: within half a step of
/// its table f_p has few edges, which rules of larger triangles may pass over.
const double kLongestSide = std::cos(kPi / 24);

/// ∫ f_p dω over a triangle of unit vectors, counter-clockwise from outside.
double over_triangle(const Vec3& a, const Vec3& b, const Vec3& c, const ProjectedArea& area) {
  if (std::min({a.dot(b), b.dot(c), c.dot(a)}) >= kLongestSide) {
    const std::array<Vec3, 3> triangle = {a, b, c};
    return spherical_integral(triangle, kAllowed, area).value;
  }
  const Vec3 ab = (a + b).normalized();
  const Vec3 bc = (b + c).normalized();
  const Vec3 ca = (c + a).normalized();
  return over_triangle(a, ab, ca, area) + over_triangle(ab, b, bc, area) +
         over_triangle(ca, bc, c, area) + over_triangle(ab, bc, ca, area);
}

/// ∫ f_p dω over what a point sees of a convex polygon, its corners relative to the point and
/// clockwise as seen from there.
double over_polygon(std::span<const Vec3> corners, const ProjectedArea& area) {
  double sum = 0;
  const Vec3 first = corners.front().normalized();
  for (std::size_t k = 2; k < corners.size(); ++k) {
    const Vec3 second = corners[k - 1].normalized();
    const Vec3 third = corners[k].normalized();
    // Slivers that cutting leaves may run the other way round, of nothing but rounding.
    if (first.dot(second.cross(third)) > 0) sum += over_triangle(first, second, third, area);
  }
  return sum;
}

/// The mesh with the backs of its one-sided patches as patches of a last surface.
PatchMesh with_backs(const PatchMesh& mesh) {
  PatchMesh result = mesh;
  const auto backs = static_cast<std::int32_t>(mesh.surface_names.size());
  result.surface_names.emplace_back("backs");
  result.surface_two_sided.push_back(false);
  for (Index i = 0; i < mesh.size(); ++i) {
    if (mesh.twin[i] >= 0) continue;
    const auto& c = mesh.corners[i];
    result.twin[i] = static_cast<std::int32_t>(result.size());
    result.add_patch(
        c[3] < 0 ? std::array{c[2], c[1], c[0], -1} : std::array{c[3], c[2], c[1], c[0]}, backs,
        mesh.polygon[i], static_cast<std::int32_t>(i));
  }
  return result;
}

}  // namespace

SeenBody::SeenBody(const Study& solved, const Eigen::VectorXd& bands, ProjectedArea area,
                   const Vec3& up)
    : mesh_(with_backs(solved.mesh)),
      radiosity_(Eigen::VectorXd::Zero(mesh_.size())),
      seen_(mesh_, Eigen::MatrixXd::Ones(mesh_.size(), 1)),
      area_(std::move(area)),
      up_(up),
      total_(total_area()),
      bands_(bands) {
  radiosity_.head(solved.mesh.size()) = solved.solution.radiosity * bands;
  if (!solved.scene.sun) return;
  to_sun_ = -solved.scene.sun->direction;
  sun_ = IncidentLight(solved.scene, solved.mesh);
}

/// ∫ f_p dω over all directions.
double SeenBody::total_area() const {
  const Vec3 u = up_.unitOrthogonal();
  const Vec3 v = up_.cross(u);
  double sum = 0;
  for (const double side : {1., -1.}) {
    for (const auto& [a, b] : {std::pair(u, v), std::pair(v, Vec3(-u)),
                               std::pair(Vec3(-u), Vec3(-v)), std::pair(Vec3(-v), u)}) {
      const std::array<Vec3, 3> octant = {side > 0 ? a : b, side > 0 ? b : a, side * up_};
      sum += over_polygon(octant, area_);
    }
  }
  return sum;
}

BodyRadiation SeenBody::at(const Vec3& point) const {
  BodyRadiation result;
  const Index n_surfaces = static_cast<Index>(mesh_.surface_names.size()) - 1;
  result.surfaces = Eigen::VectorXd::Zero(n_surfaces);
  const Index n = mesh_.size();
  for (const Vec3& side : {up_, Vec3(-up_)}) {
    seen_.look(point, side, [&](std::int32_t image_patch, std::span<const Vec3> piece) {
      const Index patch = image_patch % n;
      std::vector<Vec3> outwards(piece.rbegin(), piece.rend());
      const double share = over_polygon(outwards, area_) / total_;
      result.irradiance += share * radiosity_[patch];
      const std::int32_t surface = mesh_.surface[patch];
      (surface < n_surfaces ? result.surfaces[surface] : result.backs) += share;
    });
  }
  result.sky = std::max(0., 1 - result.surfaces.sum() - result.backs);
  if (to_sun_) {
    Eigen::VectorXd normal_irradiance = Eigen::VectorXd::Zero(bands_.size());
    sun_.add(point, *to_sun_, normal_irradiance);
    result.irradiance += kPi * area_(*to_sun_) / total_ * normal_irradiance.dot(bands_);
  }
  return result;
}

}  // namespace study
