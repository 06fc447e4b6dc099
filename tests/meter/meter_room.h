#pragma once

#include <Eigen/Geometry>

#include "radiosity/meter/photometer.h"
#include "radiosity/picture/measured_grid.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/scene/scene.h"
#include "radiosity/solve/solution.h"
#include "radiosity/visibility/visibility.h"
#include "tests/support/shapes.h"

namespace radiosity::test {

/// A room with the floor at z = 0, moved and turned, and light that is given: what lamps emit and
/// what all patches reflect, lx of one band of the weight 1.
struct MeterRoom {
  explicit MeterRoom(const Eigen::Isometry3d& where = Eigen::Isometry3d::Identity())
      : place(where) {
    scene.bands.kind = Bands::Kind::grey;
  }

  /// A parallelogram that faces u x v.
  std::int32_t add(const std::string& name, const Vec3& a, const Vec3& u, const Vec3& v, int nu,
                   int nv) {
    const auto surface = add_grid(mesh, place * a, place.linear() * u, place.linear() * v, nu, nv);
    mesh.surface_names[static_cast<std::size_t>(surface)] = name;
    return surface;
  }

  void add_walls(const Vec3& size, int n) {
    const Vec3 x(size.x(), 0, 0);
    const Vec3 y(0, size.y(), 0);
    const Vec3 z(0, 0, size.z());
    const Vec3 zero = Vec3::Zero();
    add("floor", zero, x, y, n, n);
    add("ceiling", z, y, x, n, n);
    add("left", zero, y, z, n, n);
    add("right", x, z, y, n, n);
    add("front", zero, z, x, n, n);
    add("rear", y, x, z, n, n);
  }

  /// Makes dark what was added.
  void grow() {
    solution.exitance.conservativeResizeLike(Eigen::MatrixXd::Zero(mesh.size(), 1));
    solution.radiosity.conservativeResizeLike(Eigen::MatrixXd::Zero(mesh.size(), 1));
  }

  /// Of surfaces by name, lx; the others are dark.
  void shine(const std::string& name, double emitted, double reflected) {
    grow();
    for (Index i = 0; i < mesh.size(); ++i) {
      if (mesh.surface_names[static_cast<std::size_t>(mesh.surface[i])] != name) continue;
      solution.exitance(i, 0) = emitted;
      solution.radiosity(i, 0) = emitted + reflected;
    }
  }

  [[nodiscard]] Photometer photometer() const {
    const Lighting light{scene, solution};
    return {mesh, std::span(&light, 1), Eigen::VectorXd::Ones(1)};
  }

  Eigen::Isometry3d place;
  Scene scene;
  PatchMesh mesh;
  Solution solution;
};

/// Turned about an axis and moved.
inline Eigen::Isometry3d motion(double angle, const Vec3& axis, const Vec3& step) {
  Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
  result.rotate(Eigen::AngleAxisd(angle, axis.normalized()));
  result.pretranslate(step);
  return result;
}

}  // namespace radiosity::test
