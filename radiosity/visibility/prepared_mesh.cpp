#include "radiosity/visibility/prepared_mesh.h"

#include <cmath>

#include "radiosity/base/parallel.h"

namespace radiosity {
namespace {

constexpr Index kLeafSize = 8;
constexpr Index kPrepareGrain = 1024;

}  // namespace

PreparedMesh::PreparedMesh(const PatchMesh& mesh, Index n_parts)
    : thickness(plane_thickness(mesh)) {
  const Box3 box = bounds(mesh);
  center = box.isEmpty() ? Vec3(Vec3::Zero()) : box.center();
  const PatchMesh local = centered(mesh);
  planes.resize(local.size());
  polygons.resize(local.size());
  discs.resize(local.size());
  const auto prepare = [&](Index i) {
    const HalfSpace plane{local.normal[i], local.normal[i].dot(local.centroid[i])};
    ConvexPolygon& polygon = polygons[i];
    for (int k = 0; k < local.n_corners(i); ++k) {
      const Vec3& corner = local.corner(i, k);
      const double height = plane.normal.dot(corner) - plane.offset;
      const bool is_off = std::abs(height) > thickness;
      polygon.push_back(is_off ? Vec3(corner - height * plane.normal) : corner);
    }
    planes[i] = plane;
    discs[i] = bounding_disc(polygon.points());
  };
  parallel_for(local.size(), prepare, kPrepareGrain);
  tree = make_cluster_tree(local, kLeafSize, thickness, n_parts);
  blockers = make_blockers(local, thickness);
}

}  // namespace radiosity
