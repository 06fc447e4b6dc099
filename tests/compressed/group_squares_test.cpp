// What all patches get of groups of neighbours in the mean square, by the blocks of a compressed
// operator, and which groups that says to divide.
#include <gtest/gtest.h>

#include <memory>
#include <stop_token>
#include <vector>

#include "io/scene/scene_file.h"
#include "meshing/adaptive/refinable_mesh.h"
#include "meshing/patches/patches.h"
#include "radiosity/assembly/make_dense_transport.h"
#include "radiosity/base/error.h"
#include "radiosity/base/parallel.h"
#include "radiosity/compressed/make_compressed_transport.h"
#include "radiosity/scene/radiometry.h"
#include "radiosity/solve/refinement.h"
#include "radiosity/solve/solve.h"
#include "tests/support/scene_families.h"
#include "tests/support/shapes.h"

namespace radiosity {
namespace {

/// A room whose operator has no corrections, so that its rows are what its blocks say.
class GroupSquaresOfARoom : public testing::Test {
 protected:
  GroupSquaresOfARoom()
      : mesh_(test::box_in_box(10, 5)),
        visibility_(mesh_),
        transport_(make_compressed_transport(mesh_, visibility_,
                                             {.tolerance = 1e-2, .closed = Closed::no})) {}

  [[nodiscard]] Eigen::VectorXd squares(const NeighborGroups& groups) const {
    return transport_->squares_of_groups(groups, x_, weight_, {});
  }

  /// Of each group by a product of its own, and what rounding to single precision may be off by.
  void expect_right(const NeighborGroups& groups) const {
    const Eigen::VectorXd found = squares(groups);
    for (Index g = 0; g < groups.n_groups; ++g) {
      Eigen::VectorXd b = Eigen::VectorXd::Zero(mesh_.size());
      for (Index i = 0; i < mesh_.size(); ++i) {
        if (groups.group_of[i] == g) b[i] = x_[i] / mesh_.area[i];
      }
      const double expected = weight_.dot(transport_->apply(b).col(0).cwiseAbs2());
      const double of_all = weight_.dot(transport_->apply(b.cwiseAbs()).col(0).cwiseAbs2());
      EXPECT_NEAR(found[g], expected, 1e-5 * of_all) << g;
    }
  }

  PatchMesh mesh_;
  Visibility visibility_;
  std::unique_ptr<CompressedTransport> transport_;
  Eigen::VectorXd x_ = Eigen::VectorXd::Random(mesh_.size());
  Eigen::VectorXd weight_ = Eigen::VectorXd::Random(mesh_.size()).cwiseAbs();
};

TEST_F(GroupSquaresOfARoom, AreThoseOfNeighbors) { expect_right(make_neighbor_groups(mesh_)); }

TEST_F(GroupSquaresOfARoom, AreThoseOfAnyPatches) {
  // In many clusters each, and in one alone.
  NeighborGroups groups{std::vector<std::int32_t>(mesh_.size()), 7};
  for (Index i = 0; i < mesh_.size(); ++i) {
    groups.group_of[i] = i == 3 ? 6 : static_cast<std::int32_t>(i * i % 6);
  }
  expect_right(groups);
  // All in one.
  groups = {std::vector<std::int32_t>(mesh_.size(), 0), 1};
  expect_right(groups);
}

TEST_F(GroupSquaresOfARoom, AreTheSameWithAnyNumberOfThreads) {
  const NeighborGroups groups = make_neighbor_groups(mesh_);
  const Eigen::VectorXd expected = squares(groups);
  for (const std::size_t n_threads : {1U, 3U}) {
    const ThreadLimit limit(n_threads);
    EXPECT_EQ(squares(groups), expected) << n_threads;
  }
}

TEST_F(GroupSquaresOfARoom, StopWhenTheyAreToldTo) {
  std::stop_source stop;
  stop.request_stop();
  EXPECT_THROW(
      static_cast<void>(transport_->squares_of_groups(make_neighbor_groups(mesh_), x_, weight_,
                                                      {.report = {}, .stop = stop.get_token()})),
      Interrupted);
}

/// The groups that hold most of the error by a compressed operator hold nearly as much by a dense
/// one. The errors are squares of what a group's light does, of which its verified error is the
/// smaller part.
void expect_alike(const PatchMesh& mesh, const Eigen::MatrixXd& emitted,
                  const Eigen::MatrixXd& reflected) {
  const Visibility visibility(mesh);
  const auto dense = make_dense_transport(mesh, visibility, {.tolerance = 1e-2});
  const auto compressed =
      make_compressed_transport(mesh, visibility, {.tolerance = 1e-2}, {emitted, reflected});
  const Solution solution = solve(*dense, emitted, reflected);
  const RefinementIndicator expected = refinement_indicator(mesh, *dense, solution);
  const RefinementIndicator found = refinement_indicator(mesh, *compressed, solution);
  ASSERT_EQ(found.groups.group_of, expected.groups.group_of);
  const double all = expected.squared_error.sum();
  EXPECT_NEAR(found.squared_error.sum(), all, 0.05 * all);
  constexpr double kShare = 0.8;
  std::vector<bool> is_marked(expected.groups.n_groups, false);
  const std::vector<Index> marked = patches_to_refine(found, kShare, mesh.size());
  for (const Index i : marked) is_marked[found.groups.group_of[i]] = true;
  double held = 0;
  for (Index g = 0; g < expected.groups.n_groups; ++g) {
    if (is_marked[g]) held += expected.squared_error[g];
  }
  EXPECT_GE(held, (kShare - 0.02) * all);
  const auto as_many = static_cast<double>(patches_to_refine(expected, kShare, mesh.size()).size());
  EXPECT_NEAR(static_cast<double>(marked.size()), as_many, 0.1 * as_many);
}

TEST(RefinementIndicatorOfBlocks, IsThatOfRowsInTheCornellBox) {
  const Scene scene = io::read_scene(RADIOSITY_SCENES "/cornell-box.json");
  meshing::RefinableMesh patches(meshing::make_patches(scene, {.n_patches = 800}));
  // Patches of several sizes, whose siblings are groups that clusters need not keep together.
  std::vector<Index> some;
  for (Index i = 0; i < patches.mesh().size(); i += 3) some.push_back(i);
  patches.refine(some);
  const PatchMesh& mesh = patches.mesh();
  expect_alike(mesh, exitance(scene, mesh), reflectance(scene, mesh));
}

TEST(RefinementIndicatorOfBlocks, IsThatOfRowsAmongHouses) {
  const test::FamilyScene street = test::make_family_scene(test::Family::canyon, 1);
  const PatchMesh mesh = meshing::make_patches(street.scene, {.n_patches = 1500});
  Eigen::MatrixXd emitted = Eigen::MatrixXd::Zero(mesh.size(), 1);
  for (Index i = 0; i < mesh.size(); ++i) emitted(i, 0) = mesh.polygon[i] % 5 == 0 ? 1 : 0;
  expect_alike(mesh, emitted, Eigen::MatrixXd::Constant(mesh.size(), 1, 0.5));
}

}  // namespace
}  // namespace radiosity
