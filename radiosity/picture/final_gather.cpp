#include "radiosity/picture/final_gather.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "radiosity/picture/point_gather.h"
#include "radiosity/scene/whole_mesh.h"

namespace radiosity {
namespace {

/// How far, relative to the scene's size, a point that a ray has found may be off.
constexpr double kRayError = 1e-6;
/// Points are kept within a patch by no more than this share of its size.
constexpr double kShareOfPatch = 1e-3;

}  // namespace

struct FinalGather::Implementation {
  Implementation(const PatchMesh& patch_mesh, const Eigen::MatrixXd& radiosity,
                 const IncidentLight& from_without)
      : mesh(patch_mesh), scene(patch_mesh, radiosity), incident(from_without) {
    const Box3 box = bounds(WholeMesh(mesh).mesh());
    if (!box.isEmpty()) ray_error = kRayError * box.diagonal().norm();
  }

  void keep_within_patch(std::int32_t patch, Vec3& x) const;
  void keep_out_of(const Blocker& body, const Vec3& normal, Vec3& x) const;

  const PatchMesh& mesh;
  GatherScene scene;
  IncidentLight incident;
  double ray_error = 0;  // m
};

FinalGather::FinalGather(const PatchMesh& mesh, const Eigen::MatrixXd& radiosity,
                         const IncidentLight& incident)
    : implementation_(std::make_unique<Implementation>(mesh, radiosity, incident)) {}
FinalGather::~FinalGather() = default;

bool FinalGather::are_coplanar(std::int32_t i, std::int32_t j) const {
  if (i == j) return true;
  const GatherScene& scene = implementation_->scene;
  const HalfSpace& plane = scene.planes[i];
  if (plane.normal.dot(scene.planes[j].normal) <= 0) return false;
  const ConvexPolygon& polygon = scene.polygons[j];
  return std::all_of(polygon.begin(), polygon.end(), [&](const Vec3& corner) {
    return std::abs(plane.normal.dot(corner) - plane.offset) <= scene.thickness;
  });
}

Eigen::MatrixXd FinalGather::irradiance(std::span<const SurfacePoint> points) const {
  struct Group {
    std::int32_t patch;
    std::vector<GatherPoint> points;
  };
  const GatherScene& scene = implementation_->scene;
  std::vector<Group> groups;
  for (std::size_t k = 0; k < points.size(); ++k) {
    auto group = std::find_if(groups.begin(), groups.end(), [&](const Group& candidate) {
      return are_coplanar(candidate.patch, points[k].patch);
    });
    if (group == groups.end()) group = groups.insert(groups.end(), {points[k].patch, {}});
    group->points.push_back({points[k].position - scene.center, static_cast<Index>(k)});
  }
  Eigen::MatrixXd result =
      Eigen::MatrixXd::Zero(scene.radiosity.rows(), static_cast<Index>(points.size()));
  PointGather gather(scene);
  for (Group& group : groups) gather.gather(scene.planes[group.patch], group.points, result);
  for (std::size_t k = 0; k < points.size(); ++k) {
    implementation_->incident.add(points[k].position, implementation_->mesh.normal[points[k].patch],
                                  result.col(static_cast<Index>(k)));
  }
  return result.transpose();
}

Eigen::MatrixXd FinalGather::irradiance(std::span<const Vec3> points, const Vec3& normal) const {
  const GatherScene& scene = implementation_->scene;
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(n_bands(), static_cast<Index>(points.size()));
  if (points.empty()) return result.transpose();
  std::vector<GatherPoint> places;
  for (const Vec3& point : points) {
    places.push_back({point - scene.center, static_cast<Index>(places.size())});
  }
  const HalfSpace plane = {normal, normal.dot(places.front().position)};
  PointGather(scene).gather(plane, places, result);
  for (std::size_t k = 0; k < points.size(); ++k) {
    implementation_->incident.add(points[k], normal, result.col(static_cast<Index>(k)));
  }
  return result.transpose();
}

void FinalGather::look(const Vec3& point, const Vec3& normal, const Sight& sight) const {
  const GatherScene& scene = implementation_->scene;
  const Vec3 place = point - scene.center;
  std::vector<Vec3> corners;
  PointGather(scene).visit({normal, normal.dot(place)}, place,
                           [&](std::int32_t patch, std::span<const Vec3> piece) {
                             corners.clear();
                             for (const Vec3& corner : piece) corners.push_back(corner - place);
                             sight(patch, corners);
                           });
}

Index FinalGather::n_bands() const { return implementation_->scene.radiosity.rows(); }

void FinalGather::Implementation::keep_within_patch(std::int32_t patch, Vec3& x) const {
  const HalfSpace& plane = scene.planes[patch];
  const ConvexPolygon& polygon = scene.polygons[patch];
  const double margin =
      std::min(ray_error, kShareOfPatch * std::sqrt(mesh.area[patch % mesh.size()]));
  x -= (plane.normal.dot(x) - plane.offset) * plane.normal;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec3& start = polygon[k];
    const Vec3& end = polygon[k + 1 < polygon.size() ? k + 1 : 0];
    const Vec3 inwards = plane.normal.cross(end - start).normalized();
    const double depth = inwards.dot(x - start);
    // What is further outside lies on a neighbour in the same plane.
    if (depth < margin && depth > -ray_error) x += (margin - depth) * inwards;
  }
}

void FinalGather::Implementation::keep_out_of(const Blocker& body, const Vec3& normal,
                                              Vec3& x) const {
  const HalfSpace* nearest = nullptr;
  double depth = -ray_error;
  for (const HalfSpace& face : body.faces) {
    const double height = face.normal.dot(x) - face.offset;
    const double cosine = face.normal.dot(normal);
    const bool is_own_face = cosine > 0 && std::abs(height) <= scene.thickness;
    if (height > ray_error || is_own_face) return;
    if (height > depth && cosine * cosine < 0.5) {
      nearest = &face;
      depth = height;
    }
  }
  if (nearest == nullptr) return;
  const Vec3 away = nearest->normal - nearest->normal.dot(normal) * normal;
  x += (ray_error - depth) / away.squaredNorm() * away;
}

SurfacePoint FinalGather::settled(const SurfacePoint& point) const {
  const Implementation& self = *implementation_;
  Vec3 x = point.position - self.scene.center;
  self.keep_within_patch(point.patch, x);
  const Vec3 margin = Vec3::Constant(self.ray_error);
  for (const Blocker& blocker : self.scene.blockers.blockers) {
    if (blocker.is_flat()) continue;
    if ((x.array() < (blocker.box.min() - margin).array()).any()) continue;
    if ((x.array() > (blocker.box.max() + margin).array()).any()) continue;
    self.keep_out_of(blocker, self.scene.planes[point.patch].normal, x);
  }
  return {point.patch, x + self.scene.center};
}

}  // namespace radiosity
