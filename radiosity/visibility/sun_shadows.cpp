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

/// What blocks light: all patches, one of each pair of twins.
std::vector<Occluder> all_occluders(const PatchMesh& mesh, double thickness) {
  std::vector<std::int32_t> patches;
  for (std::int32_t i = 0; i < static_cast<std::int32_t>(mesh.size()); ++i) {
    if (mesh.twin[i] < 0 || i < mesh.twin[i]) patches.push_back(i);
  }
  return make_occluders(mesh, patches, thickness);
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

}  // namespace

SunShadows::SunShadows(const PatchMesh& mesh, const Vec3& direction)
    : mesh_(mesh),
      center_(mesh.size() > 0 ? Vec3(bounds(mesh).center()) : Vec3(0, 0, 0)),
      up_(-direction),
      u_(up_.unitOrthogonal()),
      v_(up_.cross(u_)),
      thickness_(plane_thickness(mesh)),
      rounding_(mesh.size() > 0 ? kShareOfSize * bounds(mesh).diagonal().norm() : 0),
      occluders_(all_occluders(centered(mesh), thickness_)),
      tree_(frame_boxes(occluders_, u_, v_, up_, rounding_)) {
  for (const Occluder& occluder : occluders_) {
    for (const Vec3& corner : occluder.corners) top_ = std::max(top_, up_.dot(corner));
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

double SunShadows::lit_share(Index patch) const {
  const Vec3& normal = mesh_.normal[patch];
  if (cosine(normal) == 0) return 0;
  const Vec3 on_plane = mesh_.centroid[patch] - center_;
  FlatPolygon whole;
  Box3 box;
  for (int k = 0; k < mesh_.n_corners(patch); ++k) {
    const Vec3 corner = mesh_.corner(patch, k) - center_;
    whole.push_back(across(corner));
    box.extend(in_frame(corner));
  }
  box.max().z() = std::max(box.max().z(), top_);
  const double area = flat_area(whole);
  if (!(area > 0)) return 0;
  const auto is_own_plane = [&](const Occluder& occluder) {
    for (int k = 0; k < mesh_.n_corners(patch); ++k) {
      const Vec3 corner = mesh_.corner(patch, k) - center_;
      if (std::abs(occluder.normal.dot(corner) - occluder.offset) > thickness_) return false;
    }
    return true;
  };
  std::vector<FlatPolygon> lit{whole};
  bool is_cut = false;
  tree_.for_each_meeting(box, [&](std::int32_t k) {
    if (lit.empty() || is_own_plane(occluders_[k])) return;
    const FlatPolygon shadow = shadow_on(occluders_[k], on_plane, normal);
    if (shadow.size() < 3) return;
    subtract(shadow, rounding_, lit);
    is_cut = true;
  });
  if (!is_cut) return 1;
  const double rest =
      std::accumulate(lit.begin(), lit.end(), 0.0,
                      [](double sum, const FlatPolygon& part) { return sum + flat_area(part); });
  return std::clamp(rest / area, 0.0, 1.0);
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

bool SunShadows::is_lit(const Vec3& point, const Vec3& normal) const {
  const double cosine_there = cosine(normal);
  if (cosine_there == 0) return false;
  const Vec3 x = point - center_;
  const Point2 place = across(x);
  Box3 beam(in_frame(x));
  beam.max().z() = std::max(beam.max().z(), top_);
  bool is_lit = true;
  tree_.for_each_meeting(beam, [&](std::int32_t k) {
    if (!is_lit) return;
    const Occluder& occluder = occluders_[k];
    const double cosine_of_blocker = occluder.normal.dot(up_);
    if (std::abs(cosine_of_blocker) <= kAlongBeam) return;
    const double way = (occluder.offset - occluder.normal.dot(x)) / cosine_of_blocker;
    if (way * cosine_there <= thickness_) return;
    FlatPolygon outline;
    for (const Vec3& corner : occluder.corners) outline.push_back(across(corner));
    if (flat_area(outline) < 0) std::reverse(outline.begin(), outline.end());
    is_lit = !holds(outline, place, rounding_);
  });
  return is_lit;
}

}  // namespace radiosity
