#include "radiosity/visibility/prepared_mesh.h"

#include <cmath>

namespace radiosity {
namespace {

constexpr Index kLeafSize = 8;

}  // namespace

PreparedMesh::PreparedMesh(const PatchMesh& mesh) : thickness(plane_thickness(mesh)) {
  const Box3 box = bounds(mesh);
  center = box.isEmpty() ? Vec3(Vec3::Zero()) : box.center();
  const PatchMesh local = centered(mesh);
  for (Index i = 0; i < local.size(); ++i) {
    const HalfSpace plane{local.normal[i], local.normal[i].dot(local.centroid[i])};
    ConvexPolygon polygon;
    for (int k = 0; k < local.n_corners(i); ++k) {
      const Vec3& corner = local.corner(i, k);
      const double height = plane.normal.dot(corner) - plane.offset;
      const bool is_off = std::abs(height) > thickness;
      polygon.push_back(is_off ? Vec3(corner - height * plane.normal) : corner);
    }
    planes.push_back(plane);
    polygons.push_back(polygon);
    discs.push_back(bounding_disc(polygon.points()));
  }
  tree = make_cluster_tree(local, kLeafSize, thickness);
  blockers = make_blockers(local, thickness);
}

}  // namespace radiosity
