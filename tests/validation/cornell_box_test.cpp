/// The Cornell box against a path-traced reference:
/// tests/data/cornell-box/reference-radiosity-8x8.csv holds the radiosity of each polygon of
/// patches-8x8.obj (Mitsuba 3.9, standard error <= 0.3 %).

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "apps/validation/reference/cornell_reference.h"
#include "apps/validation/reference/own_light.h"
#include "io/scene/scene_file.h"
#include "meshing/patches/patches.h"
#include "radiosity/radiosity.h"

namespace {

using namespace radiosity;

using apps::validation::ReferencePolygon;

TEST(CornellBox, DefectOfTheReferenceIsWhereWeSayItIs) {
  const std::vector<ReferencePolygon> reference =
      apps::validation::read_cornell_reference(RADIOSITY_TEST_DATA);
  // Radiosity 0 in full light; the rule must find this polygon and not those under a block.
  EXPECT_EQ(apps::validation::defective_polygons(reference), std::vector<std::size_t>{321});
  EXPECT_EQ(reference[321].surface, "short_top");
  EXPECT_EQ(reference[321].radiosity.maxCoeff(), 0);
  for (const Index neighbour : {320, 322, 325}) {
    EXPECT_GT(reference[neighbour].radiosity[0], 0.7);
  }
}

TEST(CornellBox, AgreesWithPathTracing) {
  const std::vector<ReferencePolygon> reference =
      apps::validation::read_cornell_reference(RADIOSITY_TEST_DATA);
  ASSERT_EQ(reference.size(), 480U);
  const Scene scene =
      io::read_scene(RADIOSITY_TEST_DATA "/cornell-box/patches-8x8.obj", {.unit = "mm"});
  const PatchMesh mesh = meshing::make_patches(scene);
  const Visibility visibility(mesh);
  const auto transport = make_transport(mesh, visibility);
  const Solution solution = solve(*transport, exitance(scene, mesh), reflectance(scene, mesh));
  ASSERT_TRUE(solution.converged);
  const auto n = static_cast<Index>(reference.size());
  const Eigen::MatrixXd radiosity = apps::validation::polygon_means(mesh, solution.radiosity, n);
  // Patches of one polygon err alike: the error of their mean is the mean of their errors.
  const Eigen::MatrixXd sigma = apps::validation::polygon_means(
      mesh,
      with_discretisation_error(solution, discretisation_error(mesh, *transport, solution))
          .radiosity_error,
      n);

  Eigen::Array3d difference = Eigen::Array3d::Zero();
  Eigen::Array3d variance = Eigen::Array3d::Zero();
  Eigen::Array3d norm = Eigen::Array3d::Zero();
  int n_covered = 0;
  const std::vector<std::size_t> defective = apps::validation::defective_polygons(reference);
  const auto is_defective = [&](Index i) {
    return std::find(defective.begin(), defective.end(), i) != defective.end();
  };
  for (Index i = 0; i < n; ++i) {
    const ReferencePolygon& expected = reference[i];
    if (expected.surface == "light" || is_defective(i)) continue;
    const Eigen::Array3d computed = radiosity.row(i).transpose().array();
    difference += expected.area * (computed - expected.radiosity).square();
    variance += expected.area *
                (sigma.row(i).transpose().array().square() + expected.standard_error.square());
    norm += expected.area * expected.radiosity.square();
    if (expected.radiosity.maxCoeff() == 0) {
      ++n_covered;
      EXPECT_EQ(computed.maxCoeff(), 0) << "polygon " << i << " is wholly under a block";
    }
  }
  EXPECT_EQ(n_covered, 3);
  // Two standard errors: what patches of this size are known to err by, and the reference.
  for (int band = 0; band < 3; ++band) {
    EXPECT_LE(std::sqrt(difference[band]), 2 * std::sqrt(variance[band])) << "band " << band;
  }
}

}  // namespace
