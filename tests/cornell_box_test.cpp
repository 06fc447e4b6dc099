/// The Cornell box against a path-traced reference:
/// tests/data/cornell-box/reference-radiosity-8x8.csv holds the radiosity of each polygon of
/// patches-8x8.obj (Mitsuba 3.9, standard error <= 0.3 %).

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "io/scene_file.h"
#include "meshing/patches.h"
#include "radiosity/radiosity.h"

namespace {

using namespace radiosity;

/// The reference says 0 for this polygon of the short block's top, in full light and beside
/// polygons of 0.7 to 0.9: an error of the file, left out of the comparison.
constexpr Index kDefectiveReference = 321;

struct ReferencePolygon {
  std::string surface;
  double area;
  Eigen::Array3d radiosity;
};

std::vector<ReferencePolygon> read_reference() {
  std::ifstream file(RADIOSITY_TEST_DATA "/cornell-box/reference-radiosity-8x8.csv");
  std::vector<ReferencePolygon> polygons;
  std::string line;
  while (std::getline(file, line)) {
    if (line.empty() || std::isdigit(static_cast<unsigned char>(line[0])) == 0) continue;
    std::vector<std::string> fields;
    std::stringstream stream(line);
    for (std::string field; std::getline(stream, field, ',');) fields.push_back(field);
    polygons.push_back({fields[1],
                        std::stod(fields[15]),
                        {std::stod(fields[22]), std::stod(fields[23]), std::stod(fields[24])}});
  }
  return polygons;
}

/// Area-weighted means over the input polygons of a column-wise patch quantity.
Eigen::MatrixXd polygon_means(const PatchMesh& mesh, const Eigen::MatrixXd& values, Index n) {
  Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(n, values.cols());
  Eigen::VectorXd areas = Eigen::VectorXd::Zero(n);
  for (Index i = 0; i < mesh.size(); ++i) {
    sums.row(mesh.polygon[i]) += mesh.area[i] * values.row(i);
    areas[mesh.polygon[i]] += mesh.area[i];
  }
  return sums.array().colwise() / areas.array();
}

TEST(CornellBox, DefectOfTheReferenceIsWhereWeSayItIs) {
  const std::vector<ReferencePolygon> reference = read_reference();
  EXPECT_EQ(reference[kDefectiveReference].surface, "short_top");
  EXPECT_EQ(reference[kDefectiveReference].radiosity.maxCoeff(), 0);
  for (const Index neighbour : {320, 322, 325}) {
    EXPECT_GT(reference[neighbour].radiosity[0], 0.7);
  }
}

TEST(CornellBox, AgreesWithPathTracing) {
  const std::vector<ReferencePolygon> reference = read_reference();
  ASSERT_EQ(reference.size(), 480U);
  const Scene scene =
      io::read_scene(RADIOSITY_TEST_DATA "/cornell-box/patches-8x8.obj", {.unit = "mm"});
  const PatchMesh mesh = meshing::make_patches(scene);
  const Visibility visibility(mesh);
  const auto transport = make_transport(mesh, visibility);
  const Solution solution = solve(*transport, exitance(scene, mesh), reflectance(scene, mesh));
  ASSERT_TRUE(solution.converged);
  const auto n = static_cast<Index>(reference.size());
  const Eigen::MatrixXd radiosity = polygon_means(mesh, solution.radiosity, n);

  Eigen::Array3d difference = Eigen::Array3d::Zero();
  Eigen::Array3d norm = Eigen::Array3d::Zero();
  int n_covered = 0;
  for (Index i = 0; i < n; ++i) {
    const ReferencePolygon& expected = reference[i];
    if (expected.surface == "light" || i == kDefectiveReference) continue;
    const Eigen::Array3d computed = radiosity.row(i).transpose().array();
    difference += expected.area * (computed - expected.radiosity).square();
    norm += expected.area * expected.radiosity.square();
    if (expected.radiosity.maxCoeff() == 0) {
      ++n_covered;
      EXPECT_EQ(computed.maxCoeff(), 0) << "polygon " << i << " is wholly under a block";
    }
  }
  EXPECT_EQ(n_covered, 3);
  const Eigen::Array3d l2 = (difference / norm).sqrt();
  // What patches of constant radiosity allow at this size.
  EXPECT_LE(l2.maxCoeff(), 0.02);
}

}  // namespace
