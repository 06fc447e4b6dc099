/// Errors of constant patches: their estimate, and patches that are refined by it.

#include "meshing/adaptive/adaptive.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "io/scene/scene_file.h"
#include "radiosity/operator/aggregated_transport.h"
#include "radiosity/radiosity.h"
#include "radiosity/visibility/sun_edges.h"
#include "tests/support/hung_boxes.h"
#include "tests/support/shapes.h"

namespace radiosity {
namespace {

using test::add_box;
using test::box_in_box;
using test::Facing;

Solution solve_box_in_box(const PatchMesh& mesh, const Transport& transport) {
  Eigen::MatrixXd emitted = Eigen::MatrixXd::Zero(mesh.size(), 1);
  for (Index i = 0; i < mesh.size(); ++i) emitted(i, 0) = mesh.surface[i] == 1 ? 1 : 0;
  return solve(transport, emitted, Eigen::MatrixXd::Constant(mesh.size(), 1, 0.6));
}

TEST(NeighborGroups, AreSquaresOfFourInAGrid) {
  PatchMesh mesh;
  test::add_grid(mesh, Vec3::Zero(), Vec3(1, 0, 0), Vec3(0, 1, 0), 8, 8);
  const NeighborGroups groups = make_neighbor_groups(mesh);
  EXPECT_EQ(groups.n_groups, 16);
  for (Index i = 0; i < mesh.size(); ++i) {
    for (Index j = 0; j < mesh.size(); ++j) {
      const bool same_square = i / 16 == j / 16 && i % 8 / 2 == j % 8 / 2;
      EXPECT_EQ(groups.group_of[i] == groups.group_of[j], same_square);
    }
  }
  EXPECT_EQ(make_coarser_groups(mesh, groups).n_groups, 4);
}

TEST(NeighborGroups, JoinNeitherSurfacesNorFaces) {
  PatchMesh mesh = box_in_box(3, 3);
  for (Index i = 0; i < mesh.size(); ++i) mesh.surface[i] = mesh.surface[i] < 6 ? 0 : 1;
  const NeighborGroups groups = make_neighbor_groups(mesh);
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
  PatchMesh mesh = box_in_box(7, 7);
  const Visibility visibility(mesh);
  const auto transport = make_transport(mesh, visibility, {.tolerance = 0.1});
  const AggregatedTransport aggregated(*transport, make_neighbor_groups(mesh));
  for (const double value : {1.0, 0.1, 1.0 / 3, -0.7}) {
    const Eigen::MatrixXd means =
        aggregated.means(Eigen::MatrixXd::Constant(mesh.size(), 2, value));
    EXPECT_TRUE((means.array() == value).all());
  }
}

/// Exchange areas of the groups, m², by hand.
Eigen::MatrixXd summed_exchange(const Transport& transport, const NeighborGroups& groups) {
  Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(groups.n_groups, groups.n_groups);
  for (Index i = 0; i < transport.size(); ++i) {
    const Eigen::VectorXd row = transport.area()[i] * rows_of(transport).row(i);
    for (Index j = 0; j < row.size(); ++j) sums(groups.group_of[i], groups.group_of[j]) += row[j];
  }
  return sums;
}

TEST(AggregatedTransport, SumsExchangeAreas) {
  const PatchMesh mesh = box_in_box(4, 4);
  const Visibility visibility(mesh);
  const auto transport = make_transport(mesh, visibility, {.tolerance = 1e-2});
  const NeighborGroups groups = make_neighbor_groups(mesh);
  const AggregatedTransport aggregated(*transport, groups);
  const Eigen::MatrixXd factors =
      aggregated.area().cwiseInverse().asDiagonal() * summed_exchange(*transport, groups);
  // Sums of as many terms as there are patches at most, none of which is above 1.
  const double rounding = static_cast<double>(mesh.size()) * std::numeric_limits<double>::epsilon();
  for (Index i = 0; i < aggregated.size(); ++i) {
    EXPECT_LE((aggregated.row(i).transpose() - factors.row(i)).cwiseAbs().maxCoeff(), rounding);
  }
  const Eigen::MatrixXd x = Eigen::MatrixXd::Random(aggregated.size(), 3);
  EXPECT_LE((aggregated.apply(x) - factors * x).cwiseAbs().maxCoeff(), rounding);
}

/// Of the exchange areas, m².
double sum_of_errors(const Transport& transport) {
  double sum = 0;
  for (Index i = 0; i < transport.size(); ++i) {
    sum += transport.area()[i] * rows_of(transport).row_error(i).sum();
  }
  return sum;
}

/// Groups of four patches of a grid are the patches of one of half as many a side.
TEST(AggregatedTransport, IsThatOfLargerPatches) {
  constexpr double kTolerance = 1e-3;
  const PatchMesh fine_mesh = box_in_box(4, 4);
  const Visibility fine_visibility(fine_mesh);
  const auto fine =
      make_transport(fine_mesh, fine_visibility, {.tolerance = kTolerance, .closed = Closed::no});
  const NeighborGroups groups = make_neighbor_groups(fine_mesh);
  const Eigen::MatrixXd sums = summed_exchange(*fine, groups);
  const PatchMesh mesh = box_in_box(2, 2);
  const Visibility visibility(mesh);
  const auto coarse =
      make_transport(mesh, visibility, {.tolerance = kTolerance, .closed = Closed::no});
  ASSERT_EQ(groups.n_groups, mesh.size());
  std::vector<Vec3> centers(mesh.size(), Vec3::Zero());
  for (Index i = 0; i < fine_mesh.size(); ++i) {
    centers[groups.group_of[i]] += fine_mesh.centroid[i] / 4;
  }
  std::vector<Index> group_of(mesh.size());  // in other order
  for (Index i = 0; i < mesh.size(); ++i) {
    group_of[i] = std::distance(
        centers.begin(),
        std::min_element(centers.begin(), centers.end(), [&](const Vec3& a, const Vec3& b) {
          return (a - mesh.centroid[i]).norm() < (b - mesh.centroid[i]).norm();
        }));
    ASSERT_LE((centers[group_of[i]] - mesh.centroid[i]).norm(), 1e-12);
  }
  double difference = 0;
  for (Index i = 0; i < mesh.size(); ++i) {
    const Eigen::VectorXd row = coarse->area()[i] * rows_of(*coarse).row(i);
    for (Index j = 0; j < mesh.size(); ++j) {
      difference += std::abs(row[j] - sums(group_of[i], group_of[j]));
    }
  }
  // The mean of |x| is less than the standard error of x; what is proved is known to 1e-11.
  EXPECT_LE(difference, sum_of_errors(*fine) + sum_of_errors(*coarse) + 1e-10 * sums.sum());
}

TEST(KnownPairs, ComeOutAsTheyWere) {
  const PatchMesh mesh = box_in_box(4, 4);
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
  const PatchMesh mesh = box_in_box(n, n);
  const Visibility visibility(mesh);
  const auto transport = make_transport(mesh, visibility, {.tolerance = 1e-3});
  const Solution solution = solve_box_in_box(mesh, *transport);
  const DiscretisationError estimate = discretisation_error(mesh, *transport, solution);

  const PatchMesh fine_mesh = test::divided_into_four(mesh);
  const Visibility fine_visibility(fine_mesh);
  const auto fine_transport = make_transport(fine_mesh, fine_visibility, {.tolerance = 1e-3});
  const Solution fine = solve_box_in_box(fine_mesh, *fine_transport);
  const Eigen::VectorXd change =
      solution.radiosity - test::means_of_four(fine_mesh, fine.radiosity);
  const Eigen::VectorXd error = 4. / 3 * change;
  const auto n_covered = (error.array().abs() <= 2 * estimate.error.col(0).array()).count();
  EXPECT_GE(static_cast<double>(n_covered), 0.95 * static_cast<double>(mesh.size()));

  // An interval that covers by being wide would say nothing.
  const auto norm = [&](const Eigen::VectorXd& x) {
    return std::sqrt(transport->area().dot(x.cwiseAbs2()));
  };
  // Of the order p between 1 and 2, patches of half the size change 2^p times less.
  EXPECT_GE(norm(estimate.change), 2 * norm(change));
  EXPECT_LE(norm(estimate.change), 4 * norm(change));
  EXPECT_GT(estimate.order, 1.0);
  // Light that varies within patches is guessed from by how much light and exchange vary over the
  // whole patch: √12 times the standard deviation of either, if they do so evenly.
  const double left = norm(estimate.change) / (std::pow(2, estimate.order) - 1);
  EXPECT_LE(norm(estimate.error), std::hypot(left, 12 * norm(error)));
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

/// Root mean square, over the area, of what the patches are off relative to their reflected light
/// or to kDarkShare of its mean, as a tolerance is understood; largest over the bands.
double relative_difference(const Solution& solution, const Eigen::MatrixXd& truth,
                           const Eigen::VectorXd& area) {
  double largest = 0;
  for (Index c = 0; c < truth.cols(); ++c) {
    const Eigen::VectorXd reflected = solution.radiosity.col(c) - solution.exitance.col(c);
    const double least = kDarkShare * area.dot(reflected) / area.sum();
    const Eigen::VectorXd relative =
        (solution.radiosity.col(c) - truth.col(c)).cwiseQuotient(reflected.cwiseMax(least));
    largest = std::max(largest, std::sqrt(area.dot(relative.cwiseAbs2()) / area.sum()));
  }
  return largest;
}

TEST(AdaptivePatches, StopAtTheTolerance) {
  const Scene scene = io::read_scene(RADIOSITY_SCENES "/cornell-box.json");
  Index n_before = 0;
  for (const double tolerance : {0.1, 0.04}) {
    SCOPED_TRACE(tolerance);
    const meshing::AdaptiveMesh adaptive =
        meshing::make_adaptive_patches(scene, {.tolerance = tolerance, .max_patches = 3000});
    EXPECT_TRUE(adaptive.refinement.is_accurate);
    EXPECT_GT(adaptive.mesh.size(), n_before);  // no more than it takes
    n_before = adaptive.mesh.size();
    const Solution solution = solve(*adaptive.transport, exitance(scene, adaptive.mesh),
                                    reflectance(scene, adaptive.mesh));
    const PatchMesh finer = test::divided_into_four(adaptive.mesh);
    const Visibility visibility(finer);
    const auto transport = make_transport(finer, visibility);
    const Eigen::MatrixXd halved = test::means_of_four(
        finer, solve(*transport, exitance(scene, finer), reflectance(scene, finer)).radiosity);
    // Patches of half the size have at most half of the error (first order, where light stops at a
    // line), so that the whole of it is twice the change at most.
    EXPECT_LE(2 * relative_difference(solution, halved, adaptive.transport->area()), tolerance);
  }
}

// A spot of sunlight through an opening in the ceiling, along no patch: rooms that are turned and
// of other sizes.
TEST(AdaptivePatches, FollowTheSunsShadows) {
  for (const double turn : {0., 0.6}) {
    PatchMesh room;
    add_box(room, Vec3(0, 0, 0), Vec3(4, 3, 2.5), 1, Facing::inwards);
    const Eigen::AngleAxisd motion(turn, Vec3(1, 2, 3).normalized());
    Scene scene;
    scene.bands.kind = Bands::Kind::grey;
    scene.materials.resize(1);
    scene.materials[0].reflectance = Eigen::VectorXd::Constant(1, 0.5);
    scene.surfaces.resize(1);
    scene.surfaces[0].name = "room";
    scene.surfaces[0].material = 0;
    const auto add = [&](const std::vector<Vec3>& corners) {
      std::vector<std::int32_t> indices;
      for (const Vec3& corner : corners) {
        indices.push_back(static_cast<std::int32_t>(scene.vertices.size()));
        scene.vertices.emplace_back(motion * corner);
      }
      scene.add_polygon(indices, 0);
    };
    for (Index i = 0; i < room.size(); ++i) {
      if (room.surface[i] == 1) continue;  // the ceiling
      add({room.corner(i, 0), room.corner(i, 1), room.corner(i, 2), room.corner(i, 3)});
    }
    // Around an opening from (1, 1) to (1.9, 1.7).
    const double z = 2.5;
    add({{0, 0, z}, {0, 3, z}, {1, 3, z}, {1, 0, z}});
    add({{1.9, 0, z}, {1.9, 3, z}, {4, 3, z}, {4, 0, z}});
    add({{1, 0, z}, {1, 1, z}, {1.9, 1, z}, {1.9, 0, z}});
    add({{1, 1.7, z}, {1, 3, z}, {1.9, 3, z}, {1.9, 1.7, z}});
    scene.sun = Sun{.direction = motion * Vec3(0.3, 0.1, -1).normalized(),
                    .irradiance = Eigen::VectorXd::Constant(1, 100)};
    const meshing::AdaptiveMesh adaptive =
        meshing::make_adaptive_patches(scene, {.tolerance = 0.03, .max_patches = 2400});
    const PatchMesh even = meshing::make_patches(scene, {.n_patches = adaptive.mesh.size()});
    const auto off = [&](const PatchMesh& mesh) {
      const SunEdges edges = find_sun_edges(scene, mesh);
      double sum = 0;
      double area = 0;
      for (Index i = 0; i < mesh.size(); ++i) {
        sum += mesh.area[i] * square(edges.deviation[i]);
        area += mesh.area[i];
      }
      EXPECT_NEAR(edges.typical, 0.5 * 100 / std::sqrt(1.1) * std::sqrt(0.63 / area), 1e-3);
      return std::sqrt(sum / area) / edges.typical;
    };
    EXPECT_LE(off(adaptive.mesh), 10 * 0.03);
    EXPECT_LT(1.2 * off(adaptive.mesh), off(even));
  }
}

TEST(AdaptivePatches, StopWhenThePatchesAreSpent) {
  const Scene scene = io::read_scene(RADIOSITY_SCENES "/cornell-box.json");
  const meshing::AdaptiveMesh spent =
      meshing::make_adaptive_patches(scene, {.tolerance = 1e-6, .max_patches = 800});
  EXPECT_FALSE(spent.refinement.is_accurate);
  EXPECT_LE(spent.mesh.size(), 900);
}

TEST(AdaptivePatches, StopAtTheMemory) {
  const Scene scene = io::read_scene(RADIOSITY_SCENES "/cornell-box.json");
  const std::size_t memory = 3 * dense_transport_bytes(600);
  const meshing::AdaptiveMesh spent =
      meshing::make_adaptive_patches(scene, {.tolerance = 1e-6,
                                             .transport = {.memory = memory},
                                             .choice = {.kind = TransportKind::dense}});
  EXPECT_FALSE(spent.refinement.is_accurate);
  EXPECT_GT(spent.mesh.size(), 400);
  EXPECT_LE(2 * spent.transport->bytes(), memory);
}

/// Where dense form factors do not fit, compressed ones may.
TEST(AdaptivePatches, GoOnCompressedWhereTheMemoryEnds) {
  const Scene scene = io::read_scene(RADIOSITY_SCENES "/cornell-box.json");
  const std::size_t memory = 3 * dense_transport_bytes(1500);
  const auto spent_with = [&](TransportKind kind) {
    return meshing::make_adaptive_patches(scene, {.tolerance = 1e-6,
                                                  .max_patches = 2500,
                                                  .transport = {.memory = memory},
                                                  .choice = {.kind = kind}});
  };
  const meshing::AdaptiveMesh dense = spent_with(TransportKind::dense);
  const meshing::AdaptiveMesh chosen = spent_with(TransportKind::automatic);
  EXPECT_FALSE(dense.transport->report().compression.has_value());
  EXPECT_LE(dense.mesh.size(), 1.1 * 1500);
  ASSERT_TRUE(chosen.transport->report().compression.has_value());
  EXPECT_GT(chosen.mesh.size(), 2000);
  EXPECT_LE(chosen.mesh.size(), 2750);
  EXPECT_LT(chosen.refinement.error, dense.refinement.error);
}

/// The same light to the same tolerance, with about as many patches.
TEST(AdaptivePatches, AreAsGoodWithCompressedFormFactors) {
  const Scene scene = io::read_scene(RADIOSITY_SCENES "/cornell-box.json");
  constexpr double kTolerance = 0.04;
  struct Result {
    Index n_patches;
    Eigen::MatrixXd means;
  };
  const auto result_with = [&](TransportKind kind) {
    const meshing::AdaptiveMesh made = meshing::make_adaptive_patches(
        scene, {.tolerance = kTolerance, .max_patches = 3000, .choice = {.kind = kind}});
    EXPECT_TRUE(made.refinement.is_accurate);
    EXPECT_EQ(made.transport->report().compression.has_value(), kind == TransportKind::compressed);
    const Solution solution =
        solve(*made.transport, exitance(scene, made.mesh), reflectance(scene, made.mesh));
    // Means of what surfaces reflect.
    const auto n = static_cast<Index>(made.mesh.surface_names.size());
    Eigen::MatrixXd means = Eigen::MatrixXd::Zero(n, solution.radiosity.cols());
    Eigen::VectorXd areas = Eigen::VectorXd::Zero(n);
    for (Index i = 0; i < made.mesh.size(); ++i) {
      means.row(made.mesh.surface[i]) +=
          made.mesh.area[i] * (solution.radiosity.row(i) - solution.exitance.row(i));
      areas[made.mesh.surface[i]] += made.mesh.area[i];
    }
    means.array().colwise() /= areas.array();
    return Result{made.mesh.size(), means};
  };
  const Result dense = result_with(TransportKind::dense);
  const Result compressed = result_with(TransportKind::compressed);
  EXPECT_LE((compressed.means - dense.means).cwiseAbs().maxCoeff(),
            kTolerance * dense.means.maxCoeff());
  EXPECT_NEAR(static_cast<double>(compressed.n_patches), static_cast<double>(dense.n_patches),
              0.2 * static_cast<double>(dense.n_patches));
}

}  // namespace
}  // namespace radiosity
