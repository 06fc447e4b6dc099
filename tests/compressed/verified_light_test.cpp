#include "radiosity/compressed/verified_light.h"

#include <gtest/gtest.h>

#include <cmath>

#include "radiosity/assembly/make_dense_transport.h"
#include "radiosity/compressed/make_compressed_transport.h"
#include "tests/support/shapes.h"

namespace radiosity {
namespace {

TEST(VerifiedLight, IsTheErrorForThatLight) {
  PatchMesh mesh;
  test::add_box(mesh, Vec3::Zero(), Vec3::Ones(), 12, test::Facing::inwards);
  test::add_box(mesh, Vec3(0.3, 0.2, 0.1), Vec3(0.7, 0.8, 0.3), 5, test::Facing::outwards);
  const Visibility visibility(mesh);
  const TransportOptions options{.tolerance = 3e-2};
  const auto dense = make_dense_transport(mesh, visibility, {.tolerance = 1e-3});
  const auto compressed = make_compressed_transport(mesh, visibility, options);
  // Light beside the box, of which nothing was known when the operator was made; and none.
  Eigen::MatrixXd light = Eigen::MatrixXd::Zero(mesh.size(), 2);
  for (Index i = 0; i < mesh.size(); ++i) {
    light(i, 0) = (mesh.centroid[i] - Vec3(0.2, 0, 0.5)).norm() < 0.3 ? 1 : 0.01;
  }
  const auto verified = verify_light(*compressed, mesh, visibility, options, light);
  ASSERT_TRUE(verified);
  EXPECT_GE(verified->n_rows, 96);
  const Eigen::VectorXd& area = dense->area();
  const Eigen::VectorXd right = dense->apply(light).col(0);
  const Eigen::VectorXd off = compressed->apply(light).col(0) - right;
  const double truth = std::sqrt(area.dot(off.cwiseAbs2()) / area.dot(right.cwiseAbs2()));
  EXPECT_GE(verified->error, truth);
  EXPECT_LE(verified->error, 2 * truth + 1e-3);  // 96 rows tell it so well
  EXPECT_FALSE(verify_light(*dense, mesh, visibility, options, light));
}

}  // namespace
}  // namespace radiosity
