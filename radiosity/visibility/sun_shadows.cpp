#include "radiosity/visibility/sun_shadows.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "radiosity/base/parallel.h"

namespace radiosity {
namespace {

/// A cosine below this is rounding of that of a surface along the beam.
constexpr double kAlongBeam = 1e-12;
/// Rounding of coordinates across the beam, of the scene's size.
constexpr double kShareOfSize = 1e-14;

/// The parts of polygons that lie in a convex one.
std::vector<FlatPolygon> common_parts(const std::vector<FlatPolygon>& polygons,
                                      const FlatPolygon& convex) {
  std::vector<FlatPolygon> result;
  for (FlatPolygon rest : polygons) {
    for (std::size_t k = 0; k < convex.size() && rest.size() >= 3; ++k) {
      const Point2& start = convex[k];
      const Point2 along = convex[k + 1 < convex.size() ? k + 1 : 0] - start;
      const auto height = [&](const Point2& x) {
        return along.x() * (x - start).y() - along.y() * (x - start).x();
      };
      FlatPolygon inside;
      for (std::size_t i = 0; i < rest.size(); ++i) {
        const Point2& a = rest[i];
        const Point2& b = rest[i + 1 < rest.size() ? i + 1 : 0];
        const double at_a = height(a);
        const double at_b = height(b);
        if (at_a >= 0) inside.push_back(a);
        if (at_a * at_b < 0) inside.push_back(a + at_a / (at_a - at_b) * (b - a));
      }
      rest = std::move(inside);
    }
    if (rest.size() >= 3) result.push_back(std::move(rest));
  }
  return result;
}

/// The part of a polygon in front of a plane; corners within the thickness of it are on it.
std::vector<Vec3> part_in_front(const std::vector<Vec3>& corners, const Vec3& on_plane,
                                const Vec3& normal, double thickness) {
  std::vector<double> heights;
  bool any_above = false;
  bool any_below = false;
  for (const Vec3& corner : corners) {
    const double height = normal.dot(corner - on_plane);
    heights.push_back(std::abs(height) <= thickness ? 0 : height);
    any_above |= heights.back() > 0;
    any_below |= heights.back() < 0;
  }
  if (!any_above) return {};
  if (!any_below) return corners;
  std::vector<Vec3> result;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const std::size_t next = k + 1 < corners.size() ? k + 1 : 0;
    if (heights[k] >= 0) result.push_back(corners[k]);
    if (heights[k] * heights[next] < 0) {
      const double s = heights[k] / (heights[k] - heights[next]);
      result.push_back(corners[k] + s * (corners[next] - corners[k]));
    }
  }
  return result;
}

/// The boxes of polygons in the frame of unit vectors (u, v, up).
std::vector<Box3> frame_boxes(const std::vector<Occluder>& occluders, const Vec3& u, const Vec3& v,
                              const Vec3& up, double margin) {
  std::vector<Box3> boxes;
  for (const Occluder& occluder : occluders) {
    Box3 box;
    for (const Vec3& x : occluder.corners) box.extend(Vec3(u.dot(x), v.dot(x), up.dot(x)));
    boxes.push_back(grown(box, margin));
  }
  return boxes;
}

double total_area(const std::vector<FlatPolygon>& parts) {
  return std::accumulate(parts.begin(), parts.end(), 0.0,
                         [](double sum, const FlatPolygon& part) { return sum + flat_area(part); });
}

}  // namespace

SunShadows::SunShadows(const PatchMesh& mesh, const Vec3& direction, std::span<const int> pane)
    : mesh_(mesh),
      center_(mesh.size() > 0 ? Vec3(bounds(mesh).center()) : Vec3(0, 0, 0)),
      up_(-direction),
      u_(up_.unitOrthogonal()),
      v_(up_.cross(u_)),
      thickness_(plane_thickness(mesh)),
      rounding_(mesh.size() > 0 ? kShareOfSize * bounds(mesh).diagonal().norm() : 0),
      occluders_(occluders_of_kind(centered(mesh), pane, -1, thickness_)),
      tree_(frame_boxes(occluders_, u_, v_, up_, rounding_)) {
  for (const Occluder& occluder : occluders_) {
    for (const Vec3& corner : occluder.corners) top_ = std::max(top_, up_.dot(corner));
  }
  const int most = pane.empty() ? -1 : *std::max_element(pane.begin(), pane.end());
  for (int kind = 0; kind <= most; ++kind) {
    for (Occluder& occluder : occluders_of_kind(centered(mesh), pane, kind, thickness_)) {
      panes_.push_back({std::move(occluder), kind});
    }
  }
}

double SunShadows::cosine(const Vec3& normal) const {
  const double cosine = normal.dot(up_);
  return cosine > kAlongBeam ? cosine : 0;
}

FlatPolygon SunShadows::shadow_on(const Occluder& occluder, const Vec3& on_plane,
                                  const Vec3& normal) const {
  FlatPolygon shadow;
  for (const Vec3& corner : part_in_front(occluder.corners, on_plane, normal, thickness_)) {
    shadow.push_back(across(corner));
  }
  double perimeter = 0;
  for (std::size_t k = 0; k < shadow.size(); ++k) {
    perimeter += (shadow[k + 1 < shadow.size() ? k + 1 : 0] - shadow[k]).norm();
  }
  const double area = flat_area(shadow);
  if (std::abs(area) <= rounding_ * perimeter) return {};  // seen edge-on it hides nothing
  if (area < 0) std::reverse(shadow.begin(), shadow.end());
  return shadow;
}

bool SunShadows::is_in_plane(const Occluder& occluder, Index patch) const {
  for (int k = 0; k < mesh_.n_corners(patch); ++k) {
    const Vec3 corner = mesh_.corner(patch, k) - center_;
    if (std::abs(occluder.normal.dot(corner) - occluder.offset) > thickness_) return false;
  }
  return true;
}

SunShadows::Lit SunShadows::lit_parts(Index patch) const {
  const Vec3& normal = mesh_.normal[patch];
  if (cosine(normal) == 0) return {};
  const Vec3 on_plane = mesh_.centroid[patch] - center_;
  FlatPolygon whole;
  Box3 box;
  for (int k = 0; k < mesh_.n_corners(patch); ++k) {
    const Vec3 corner = mesh_.corner(patch, k) - center_;
    whole.push_back(across(corner));
    box.extend(in_frame(corner));
  }
  box.max().z() = std::max(box.max().z(), top_);
  Lit lit{.parts = {whole}, .area = flat_area(whole)};
  if (!(lit.area > 0)) return {};
  tree_.for_each_meeting(box, [&](std::int32_t k) {
    if (lit.parts.empty() || is_in_plane(occluders_[k], patch)) return;
    const FlatPolygon shadow = shadow_on(occluders_[k], on_plane, normal);
    if (shadow.size() < 3) return;
    subtract(shadow, rounding_, lit.parts);
    lit.is_cut = true;
  });
  return lit;
}

double SunShadows::lit_share(Index patch) const {
  const Lit lit = lit_parts(patch);
  if (lit.area == 0) return 0;
  if (!lit.is_cut) return 1;
  return std::clamp(total_area(lit.parts) / lit.area, 0.0, 1.0);
}

void SunShadows::add_through(Index patch, std::vector<FlatPolygon> parts, std::size_t first,
                             const Eigen::VectorXd& so_far, const PaneFactor& factor,
                             Eigen::VectorXd& sum) const {
  const Vec3 on_plane = mesh_.centroid[patch] - center_;
  for (std::size_t k = first; k < panes_.size() && !parts.empty(); ++k) {
    if (is_in_plane(panes_[k].occluder, patch)) continue;
    const FlatPolygon seen = shadow_on(panes_[k].occluder, on_plane, mesh_.normal[patch]);
    if (seen.size() < 3) continue;
    std::vector<FlatPolygon> through = common_parts(parts, seen);
    if (through.empty()) continue;
    const double cosine_there = std::abs(panes_[k].occluder.normal.dot(up_));
    add_through(patch, std::move(through), k + 1,
                so_far.cwiseProduct(factor(panes_[k].kind, cosine_there)), factor, sum);
    subtract(seen, rounding_, parts);
  }
  sum += total_area(parts) * so_far;
}

Eigen::MatrixXd SunShadows::shares_through_panes(Index n_bands, const PaneFactor& factor,
                                                 const Progress& progress) const {
  if (panes_.empty()) return lit_shares(progress).replicate(1, n_bands);
  constexpr std::ptrdiff_t kGrain = 64;
  Eigen::MatrixXd shares = Eigen::MatrixXd::Zero(mesh_.size(), n_bands);
  parallel_ranges(mesh_.size(), kGrain, [&](std::ptrdiff_t begin, std::ptrdiff_t end) {
    progress.check();
    for (std::ptrdiff_t i = begin; i < end; ++i) {
      Lit lit = lit_parts(i);
      if (lit.area == 0) continue;
      Eigen::VectorXd sum = Eigen::VectorXd::Zero(n_bands);
      add_through(i, std::move(lit.parts), 0, Eigen::VectorXd::Ones(n_bands), factor, sum);
      shares.row(i) = sum.transpose() / lit.area;
    }
  });
  return shares.cwiseMax(0).cwiseMin(1);
}

Eigen::VectorXd SunShadows::lit_shares(const Progress& progress) const {
  constexpr std::ptrdiff_t kGrain = 64;
  Eigen::VectorXd shares(mesh_.size());
  parallel_ranges(mesh_.size(), kGrain, [&](std::ptrdiff_t begin, std::ptrdiff_t end) {
    progress.check();
    for (std::ptrdiff_t i = begin; i < end; ++i) shares[i] = lit_share(i);
  });
  return shares;
}

bool SunShadows::meets(const Occluder& occluder, const Vec3& x, double cosine_there) const {
  const double cosine_of_blocker = occluder.normal.dot(up_);
  if (std::abs(cosine_of_blocker) <= kAlongBeam) return false;
  const double way = (occluder.offset - occluder.normal.dot(x)) / cosine_of_blocker;
  if (way * cosine_there <= thickness_) return false;
  FlatPolygon outline;
  for (const Vec3& corner : occluder.corners) outline.push_back(across(corner));
  if (flat_area(outline) < 0) std::reverse(outline.begin(), outline.end());
  return holds(outline, across(x), rounding_);
}

Eigen::VectorXd SunShadows::factor_at(const Vec3& point, const Vec3& normal, Index n_bands,
                                      const PaneFactor& factor) const {
  Eigen::VectorXd result = Eigen::VectorXd::Ones(n_bands);
  for (const Pane& pane : panes_) {
    if (!meets(pane.occluder, point - center_, cosine(normal))) continue;
    result.array() *= factor(pane.kind, std::abs(pane.occluder.normal.dot(up_))).array();
  }
  return result;
}

bool SunShadows::is_lit(const Vec3& point, const Vec3& normal) const {
  const double cosine_there = cosine(normal);
  if (cosine_there == 0) return false;
  const Vec3 x = point - center_;
  Box3 beam(in_frame(x));
  beam.max().z() = std::max(beam.max().z(), top_);
  bool is_lit = true;
  tree_.for_each_meeting(
      beam, [&](std::int32_t k) { is_lit = is_lit && !meets(occluders_[k], x, cosine_there); });
  return is_lit;
}

}  // namespace radiosity
