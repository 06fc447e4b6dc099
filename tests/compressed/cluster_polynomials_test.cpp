#include "radiosity/compressed/cluster_polynomials.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "radiosity/compressed/compressed_blocks.h"
#include "radiosity/compressed/polynomial_space.h"
#include "tests/support/shapes.h"

namespace radiosity {
namespace {

constexpr Index kLeafSize = 8;

/// A sphere about the origin, of facets that look inwards, as a cube's faces divided and blown up.
PatchMesh sphere(int n) {
  PatchMesh mesh;
  test::add_box(mesh, -Vec3::Ones(), Vec3::Ones(), n, test::Facing::inwards);
  PatchMesh result;
  for (const Vec3& vertex : mesh.vertices) result.vertices.push_back(vertex.normalized());
  result.surface_names = {"sphere"};
  result.surface_two_sided = {false};
  for (Index i = 0; i < mesh.size(); ++i) {
    const auto& c = mesh.corners[i];
    result.add_patch({c[0], c[1], c[2], -1}, 0, static_cast<std::int32_t>(result.size()));
    result.add_patch({c[0], c[2], c[3], -1}, 0, static_cast<std::int32_t>(result.size()));
  }
  return result;
}

TEST(PolynomialSpace, SubstitutesAffineMaps) {
  const PolynomialSpace outer(2, 4);
  const PolynomialSpace inner(2, 4);
  EXPECT_EQ(outer.size(), 15);
  EXPECT_EQ(PolynomialSpace(6, 2).size(), 28);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const Eigen::MatrixXd map = Eigen::MatrixXd::NullaryExpr(2, 3, [&] { return uniform(random); });
  const Eigen::MatrixXd substituted = outer.substituted(map, inner);
  const Eigen::Vector2d z(uniform(random), uniform(random));
  const Eigen::Vector2d mapped = map.col(0) + map.rightCols(2) * z;
  Eigen::VectorXd of_inner(inner.size());
  Eigen::VectorXd of_outer(outer.size());
  inner.evaluate(z.data(), of_inner.data());
  outer.evaluate(mapped.data(), of_outer.data());
  EXPECT_LT((substituted * of_inner - of_outer).cwiseAbs().maxCoeff(), 1e-13);
}

class Polynomials : public testing::TestWithParam<bool> {
 protected:
  Polynomials()
      : mesh_(GetParam() ? sphere(8) : test::box_in_box(8, 4)),
        tree_(make_cluster_tree(mesh_, kLeafSize, 1e-9)),
        polynomials_(mesh_, tree_) {}

  PatchMesh mesh_;
  ClusterTree tree_;
  ClusterPolynomials polynomials_;
};

TEST_P(Polynomials, AreOrthonormalByRisingDegree) {
  for (std::int32_t c = 0; c < static_cast<std::int32_t>(tree_.clusters.size()); ++c) {
    const Cluster& cluster = tree_.clusters[c];
    const int degree = polynomials_.most_degree(c);
    const int n = polynomials_.counts(c)[degree];
    ASSERT_LE(n, cluster.end - cluster.begin);
    EXPECT_EQ(polynomials_.counts(c)[0], 1);
    Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(n, n);
    Eigen::VectorXd values(n);
    for (Index k = cluster.begin; k < cluster.end; ++k) {
      const std::int32_t patch = tree_.order[k];
      polynomials_.evaluate(c, patch, degree, values.data());
      EXPECT_NEAR(values[0], 1, 1e-6);
      gram += mesh_.area[patch] * values * values.transpose();
    }
    gram /= polynomials_.area(c);
    // Coefficients are single: they may be as large as what is left of a polynomial is small.
    EXPECT_LT((gram - Eigen::MatrixXd::Identity(n, n)).cwiseAbs().maxCoeff(), 1e-3) << c;
  }
}

TEST_P(Polynomials, OfParentsAreThoseOfTheirChildren) {
  // One block of each cluster with the root, of coefficients that pick the functions apart.
  const auto n_clusters = static_cast<std::int32_t>(tree_.clusters.size());
  for (std::int32_t c = 0; c < n_clusters; c += 5) {
    const auto degree = static_cast<std::int8_t>(polynomials_.most_degree(c));
    std::vector<std::int8_t> degrees(n_clusters, -1);
    degrees[c] = degree;
    degrees[0] = std::max<std::int8_t>(degrees[0], 0);
    CompressedBlocks blocks;
    blocks.basis = polynomials_.make_basis(degrees);
    blocks.far.push_back({c, 0, {degree, 0}, 0, 0});
    const int n = polynomials_.counts(c)[degree];
    for (int k = 0; k < n; ++k) blocks.coefficients.push_back(static_cast<float>(1 + k));
    const CompressedMatrix matrix(blocks);
    Eigen::VectorXd values(n);
    for (Index k = tree_.clusters[c].begin; k < tree_.clusters[c].end; ++k) {
      polynomials_.evaluate(c, tree_.order[k], degree, values.data());
      double expected = 0;
      for (int f = 0; f < n; ++f) expected += (1 + f) * values[f];
      // The root holds every patch, one outside the cluster if there is any.
      const Index other = k == 0 ? matrix.size() - 1 : 0;
      if (other >= tree_.clusters[c].begin && other < tree_.clusters[c].end) continue;
      // What is no function of its own on a child (1e-3 of its size) is left out there.
      EXPECT_NEAR(matrix.entry(k, other).density, expected, 2e-3 * n * n) << c;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Shapes, Polynomials, testing::Values(false, true),
                         [](const auto& shape) { return shape.param ? "sphere" : "boxes"; });

}  // namespace
}  // namespace radiosity
