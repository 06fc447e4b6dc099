#include "study/row_check.h"

#include <gtest/gtest.h>

#include <string>

#include "io/scene/scene_file.h"
#include "meshing/patches/patches.h"
#include "radiosity/base/error.h"

namespace study {
namespace {

using namespace radiosity;

/// What is said of a unit cube whose coordinates are rounded like that, if a row sums to so much.
std::string refusal(double precision, double sum) {
  Scene scene = io::read_scene(RADIOSITY_SCENES "/furnace-cube.json");
  const PatchMesh mesh = meshing::make_patches(scene, {});
  scene.precision = precision;
  AssemblyReport report;
  report.row_sums = Eigen::VectorXd::Ones(mesh.size());
  report.row_sums[2] = sum;
  try {
    refuse_excess(scene, mesh, report, 1e-3, [&](Index row) {
      EXPECT_EQ(row, 2);
      return Eigen::VectorXd(Eigen::VectorXd::Constant(mesh.size(), 1e-3));
    });
  } catch (const SolveError& error) {
    return error.what();
  }
  return "";
}

TEST(RefuseExcess, NamesThePatchAndTheLikelyCause) {
  const std::string exact = refusal(0, 1.07);
  EXPECT_NE(exact.find("add up to 1.07, but"), std::string::npos) << exact;
  EXPECT_NE(exact.find("radiosity inspect"), std::string::npos) << exact;
  const std::string rounded = refusal(0.05, 1.07);
  EXPECT_NE(rounded.find("it is 1 m large where coordinates are taken as rounded to 0.05 m"),
            std::string::npos)
      << rounded;
}

TEST(RefuseExcess, LetsPassWhatErrorsAndToleranceExplain) {
  EXPECT_EQ(refusal(0, 1.009), "");
  EXPECT_EQ(refusal(0, 1.029), "");  // 6 √6 + 6 of 1e-3 more
  EXPECT_NE(refusal(0, 1.032), "");
}

}  // namespace
}  // namespace study
