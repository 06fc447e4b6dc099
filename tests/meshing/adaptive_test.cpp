/// Errors of constant patches: their estimate, and patches that are refined by it.

#include "meshing/adaptive/adaptive.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "io/scene/scene_file.h"
#include "radiosity/operator/aggregated_transport.h"
#include "radiosity/radiosity.h"
#include "tests/support/shapes.h"

namespace radiosity {
namespace {

using test::add_box;
using test::Facing;

/// Unit cube with a box in it; of each face n x n patches.
PatchMesh box_in_box(int n) {
  PatchMesh mesh;
  add_box(mesh, Vec3::Zero(), Vec3::Ones(), n, Facing::inwards);
  add_box(mesh, Vec3(0.35, 0.3, 0.25), Vec3(0.65, 0.6, 0.75), n, Facing::outwards);
  return mesh;
}

Solution solve_box_in_box(const PatchMesh& mesh, const Transport& transport) {
  Eigen::MatrixXd emitted = Eigen::MatrixXd::Zero(mesh.size(), 1);
  for (Index i = 0; i < mesh.size(); ++i) emitted(i, 0) = mesh.surface[i] == 1 ? 1 : 0;
  return solve(transport, emitted, Eigen::MatrixXd::Constant(mesh.size(), 1, 0.6));
}

TEST(PatchGroups, AreSquaresOfFourInAGrid) {
  PatchMesh mesh;
  test::add_grid(mesh, Vec3::Zero(), Vec3(1, 0, 0), Vec3(0, 1, 0), 8, 8);
  const PatchGroups groups = make_patch_groups(mesh);
  EXPECT_EQ(groups.n_groups, 16);
  for (Index i = 0; i < mesh.size(); ++i) {
    for (Index j = 0; j < mesh.size(); ++j) {
      const bool same_square = i / 16 == j / 16 && i % 8 / 2 == j % 8 / 2;
      EXPECT_EQ(groups.group_of[i] == groups.group_of[j], same_square);
    }
  }
  EXPECT_EQ(make_coarser_groups(mesh, groups).n_groups, 4);
}

TEST(PatchGroups, JoinNeitherSurfacesNorFaces) {
  PatchMesh mesh = box_in_box(3);
  for (Index i = 0; i < mesh.size(); ++i) mesh.surface[i] = mesh.surface[i] < 6 ? 0 : 1;
  const PatchGroups groups = make_patch_groups(mesh);
  for (Index i = 0; i < mesh.size(); ++i) {
    for (Index j = 0; j < mesh.size(); ++j) {
      if (groups.group_of[i] != groups.group_of[j]) continue;
      EXPECT_EQ(mesh.surface[i], mesh.surface[j]);
      EXPECT_GT(mesh.normal[i].dot(mesh.normal[j]), 0.9);
    }
  }
}

// Else patches that are all white are whiter than white together, which no solve accepts.
TEST(AggregatedTransport, MeansStayWithinTheirValues) {
  PatchMesh mesh = box_in_box(7);
  const Visibility visibility(mesh);
  const auto transport = make_transport(mesh, visibility, {.tolerance = 0.1});
  const AggregatedTransport aggregated(*transport, make_patch_groups(mesh));
  for (const double value : {1.0, 0.1, 1.0 / 3, -0.7}) {
    const Eigen::MatrixXd means =
        aggregated.means(Eigen::MatrixXd::Constant(mesh.size(), 2, value));
    EXPECT_TRUE((means.array() == value).all());
  }
}

TEST(AggregatedTransport, SumsExchangeAreas) {
  const PatchMesh fine_mesh = box_in_box(4);
  const Visibility fine_visibility(fine_mesh);
  const auto fine = make_transport(fine_mesh, fine_visibility, {.tolerance = 1e-4});
  const AggregatedTransport aggregated(*fine, make_patch_groups(fine_mesh));
  const PatchMesh coarse_mesh = box_in_box(2);
  const Visibility coarse_visibility(coarse_mesh);
  const auto coarse = make_transport(coarse_mesh, coarse_visibility, {.tolerance = 1e-4});
  ASSERT_EQ(aggregated.size(), coarse->size());
  // The groups of the one are the patches of the other, in some order.
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(coarse->size());
  EXPECT_NEAR(aggregated.area().sum(), coarse->area().sum(), 1e-12);
  const Eigen::MatrixXd twice = aggregated.apply(aggregated.apply(ones));
  EXPECT_NEAR(aggregated.area().dot(twice.col(0)),
              coarse->area().dot(coarse->apply(coarse->apply(ones)).col(0)),
              1e-3 * coarse->area().sum());
  for (const Index i : {0, 7, 30}) {
    EXPECT_LT((aggregated.row(i) -
               aggregated.apply(Eigen::MatrixXd::Identity(coarse->size(), coarse->size()))
                   .row(i)
                   .transpose())
                  .cwiseAbs()
                  .maxCoeff(),
              1e-6);
  }
}

TEST(KnownPairs, ComeOutAsTheyWere) {
  const PatchMesh mesh = box_in_box(4);
  const Visibility visibility(mesh);
  const auto before = make_transport(mesh, visibility, {.tolerance = 1e-3, .closed = Closed::no});
  // The same patches, but one of them unknown.
  std::vector<std::int32_t> same(mesh.size());
  for (std::size_t i = 0; i < same.size(); ++i) same[i] = static_cast<std::int32_t>(i);
  same[17] = -1;
  const auto after = make_transport(
      mesh, visibility, {.tolerance = 1e-3, .closed = Closed::no, .known = {before.get(), same}});
  EXPECT_GT(after->report().known, 0.9 * static_cast<double>(before->report().facing));
  for (Index i = 0; i < mesh.size(); ++i) {
    EXPECT_EQ(rows_of(*after).row(i), rows_of(*before).row(i));
    EXPECT_EQ(rows_of(*after).row_error(i), rows_of(*before).row_error(i));
  }
}

/// The estimate against the change to patches of half the size and on to the limit (second order).
TEST(DiscretisationError, CoversTheTruth) {
  const int n = 8;
  const PatchMesh mesh = box_in_box(n);
  const Visibility visibility(mesh);
  const auto transport = make_transport(mesh, visibility, {.tolerance = 1e-3});
  const Solution solution = solve_box_in_box(mesh, *transport);
  const DiscretisationError estimate = discretisation_error(mesh, *transport, solution);

  const PatchMesh fine_mesh = box_in_box(2 * n);
  const Visibility fine_visibility(fine_mesh);
  const auto fine_transport = make_transport(fine_mesh, fine_visibility, {.tolerance = 1e-3});
  const Solution fine = solve_box_in_box(fine_mesh, *fine_transport);
  int n_covered = 0;
  std::vector<double> errors;
  std::vector<double> intervals;
  for (Index i = 0; i < mesh.size(); ++i) {
    const Index face = i / (n * n);
    const Index row = i % (n * n) / n;
    const Index column = i % n;
    double mean = 0;
    for (const Index a : {0, 1}) {
      for (const Index b : {0, 1}) {
        mean += fine.radiosity(face * 4 * n * n + (2 * row + a) * 2 * n + 2 * column + b, 0) / 4;
      }
    }
    const double truth = mean + (mean - solution.radiosity(i, 0)) / 3;
    errors.push_back(std::abs(solution.radiosity(i, 0) - truth));
    intervals.push_back(2 * estimate.error(i, 0));
    if (errors.back() <= intervals.back()) ++n_covered;
  }
  EXPECT_GE(n_covered, 0.95 * static_cast<double>(mesh.size()));
  std::nth_element(errors.begin(), errors.begin() + mesh.size() / 2, errors.end());
  std::nth_element(intervals.begin(), intervals.begin() + mesh.size() / 2, intervals.end());
  // An interval that covers by being wide would say nothing. For Gaussian errors this is 3.
  EXPECT_LE(intervals[mesh.size() / 2], 8 * errors[mesh.size() / 2]);
  EXPECT_GT(estimate.order, 1.0);
}

TEST(DiscretisationError, IsZeroInAFurnace) {
  PatchMesh mesh;
  add_box(mesh, Vec3::Zero(), Vec3::Ones(), 4, Facing::inwards);
  const Visibility visibility(mesh);
  const auto transport = make_transport(mesh, visibility);
  const Solution solution = solve(*transport, Eigen::MatrixXd::Ones(mesh.size(), 1),
                                  Eigen::MatrixXd::Constant(mesh.size(), 1, 0.5));
  const DiscretisationError estimate = discretisation_error(mesh, *transport, solution);
  // What is left is the coarser solutions' own tolerance.
  EXPECT_LE(estimate.error.maxCoeff(), 1e-4 * solution.radiosity.maxCoeff());
}

TEST(DiscretisationError, AddsInQuadrature) {
  Solution solution;
  solution.radiosity_error = Eigen::MatrixXd::Constant(2, 1, 3);
  DiscretisationError estimate;
  estimate.error = Eigen::MatrixXd::Constant(2, 1, 4);
  EXPECT_EQ(with_discretisation_error(solution, estimate).radiosity_error(1, 0), 5);
}

/// The Cornell box by polygons: adaptive patches against the radiosity on many more, made alike.
TEST(AdaptivePatches, AreBetterThanAsManyOfOneSize) {
  const Scene scene =
      io::read_scene(RADIOSITY_TEST_DATA "/cornell-box/patches-8x8.obj", {.unit = "mm"});
  const auto polygon_means = [&](const PatchMesh& mesh, const Transport& transport) {
    const Solution solution = solve(transport, exitance(scene, mesh), reflectance(scene, mesh));
    EXPECT_TRUE(solution.radiosity.allFinite());
    EXPECT_TRUE(solution.radiosity_error.allFinite());
    Eigen::VectorXd sums = Eigen::VectorXd::Zero(scene.n_polygons());
    Eigen::VectorXd areas = Eigen::VectorXd::Zero(scene.n_polygons());
    for (Index i = 0; i < mesh.size(); ++i) {
      sums[mesh.polygon[i]] += mesh.area[i] * (solution.radiosity(i, 0) - solution.exitance(i, 0));
      areas[mesh.polygon[i]] += mesh.area[i];
    }
    return Eigen::VectorXd(sums.cwiseQuotient(areas.cwiseSqrt()));
  };
  const auto adaptive_means = [&](double tolerance, long most, Index& n_patches) {
    const meshing::AdaptiveMesh adaptive =
        meshing::make_adaptive_patches(scene, {.tolerance = tolerance, .max_patches = most});
    n_patches = adaptive.mesh.size();
    EXPECT_LE(n_patches, 1.1 * static_cast<double>(most));
    return polygon_means(adaptive.mesh, *adaptive.transport);
  };
  Index n_truth = 0;
  Index n_adaptive = 0;
  const Eigen::VectorXd truth = adaptive_means(1e-9, 2700, n_truth);
  const Eigen::VectorXd adaptive = adaptive_means(1e-9, 800, n_adaptive);
  const PatchMesh uniform_mesh =
      meshing::make_patches(scene, {.n_patches = static_cast<long>(n_adaptive)});
  const Visibility visibility(uniform_mesh);
  const Eigen::VectorXd uniform =
      polygon_means(uniform_mesh, *make_transport(uniform_mesh, visibility));
  EXPECT_GE(uniform_mesh.size(), 0.95 * static_cast<double>(n_adaptive));
  EXPECT_LT((adaptive - truth).norm(), (uniform - truth).norm());
}

TEST(AdaptivePatches, StopAtTheTolerance) {
  const Scene scene = io::read_scene(RADIOSITY_SCENES "/cornell-box.json");
  const meshing::AdaptiveMesh coarse =
      meshing::make_adaptive_patches(scene, {.tolerance = 0.05, .max_patches = 3000});
  EXPECT_TRUE(coarse.refinement.is_accurate);
  EXPECT_LE(coarse.refinement.error, 0.05);
  const meshing::AdaptiveMesh spent =
      meshing::make_adaptive_patches(scene, {.tolerance = 1e-6, .max_patches = 800});
  EXPECT_FALSE(spent.refinement.is_accurate);
  EXPECT_LE(spent.mesh.size(), 900);
}

TEST(AdaptivePatches, StopAtTheMemory) {
  const Scene scene = io::read_scene(RADIOSITY_SCENES "/cornell-box.json");
  const std::size_t memory = 3 * dense_transport_bytes(600);
  const meshing::AdaptiveMesh spent =
      meshing::make_adaptive_patches(scene, {.tolerance = 1e-6, .transport = {.memory = memory}});
  EXPECT_FALSE(spent.refinement.is_accurate);
  EXPECT_GT(spent.mesh.size(), 400);
  EXPECT_LE(2 * spent.transport->bytes(), memory);
}

}  // namespace
}  // namespace radiosity
