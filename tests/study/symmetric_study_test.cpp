// Scenes that are a part of a symmetric whole, from the file to the light and a picture.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "io/scene/scene_file.h"
#include "io/scene/scene_writer.h"
#include "radiosity/base/error.h"
#include "radiosity/picture/final_gather.h"
#include "radiosity/picture/gathered_picture.h"
#include "radiosity/picture/render.h"
#include "radiosity/scene/radiometry.h"
#include "radiosity/scene/whole_mesh.h"
#include "study/study.h"
#include "tests/support/messages.h"
#include "tests/support/output_folder.h"

namespace {

using namespace radiosity;

constexpr const char* kMaterials = R"("unit": "m", "bands": "grey", "materials": {
    "warm": {"emissivity": 0.8, "temperature": 400},
    "cold": {"emissivity": 0.5, "temperature": 300}},)";
/// Of a box of 2 x 2 x 1 m about the origin: the quarter with x and y above 0.
constexpr const char* kQuarter = R"("surfaces": [
    {"name": "floor", "material": "warm",
     "polygons": [[[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]]},
    {"name": "ceiling", "material": "cold",
     "polygons": [[[0, 0, 1], [0, 1, 1], [1, 1, 1], [1, 0, 1]]]},
    {"name": "wall", "material": "cold",
     "polygons": [[[1, 0, 0], [1, 0, 1], [1, 1, 1], [1, 1, 0]],
                  [[0, 1, 0], [1, 1, 0], [1, 1, 1], [0, 1, 1]]]}])";

class SymmetricStudy : public OutputFolder {
 protected:
  Scene read(const std::string& content) {
    const auto path = folder() / "part.json";
    std::ofstream(path) << "{" << content << "}";
    return io::read_scene(path);
  }
  Scene quarter(const std::string& symmetry) {
    return read(std::string(kMaterials) + kQuarter + R"(, "symmetry": )" + symmetry);
  }
  static std::string error_of(const Scene& scene, const study::StudyOptions& options = {}) {
    try {
      study::run(scene, options);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  }
};

study::StudyOptions few_patches() {
  return {.patches = {.max_edge = 0.51}, .tolerance = 1e-3, .factor_tolerance = 1e-7};
}

/// All images as a mesh of its own.
study::Study whole_study(const study::Study& part) {
  study::Study whole{.scene = part.scene,
                     .mesh = make_whole(part.mesh),
                     .visibility = Visibility(PatchMesh{}),
                     .transport = nullptr,
                     .factor_tolerance = part.factor_tolerance};
  whole.scene.symmetry = {};
  whole.visibility = Visibility(whole.mesh);
  whole.transport =
      study::make_form_factors(whole.scene, whole.mesh, whole.visibility, few_patches()).transport;
  return study::with_light(std::move(whole), few_patches());
}

TEST_F(SymmetricStudy, QuarterHasTheLightAndPictureOfTheWhole) {
  const study::Study part = study::run(quarter(R"({"mirror": ["x=0", "y = 0"]})"), few_patches());
  ASSERT_EQ(part.mesh.images.size(), 3U);
  EXPECT_TRUE(part.transport->report().closed);
  const study::Study whole = whole_study(part);
  const Index n = part.mesh.size();
  for (Index g = 0; g < 4; ++g) {
    const Eigen::MatrixXd off =
        whole.solution.radiosity.middleRows(g * n, n) - part.solution.radiosity;
    // Two iterations, each to 1e-6 of the light or better.
    EXPECT_LT(off.norm(), 2e-6 * part.solution.radiosity.norm()) << g;
  }
  const Camera camera{Vec3(-0.9, -0.8, 0.3), Vec3(1, 0.9, 0.1).normalized(), Vec3::UnitZ(), 1.4};
  const RenderOptions options{.width = 24, .height = 16, .samples = 1};
  const auto gathered = [&](const study::Study& study) {
    const FinalGather gather(study.mesh, study.solution.radiosity);
    return render_gathered(
               gather, study.visibility,
               {exitance(study.scene, study.mesh), reflectance(study.scene, study.mesh)}, camera,
               options)
        .values;
  };
  const Eigen::MatrixXf picture = gathered(part);
  EXPECT_GT(picture.minCoeff(), 0);
  EXPECT_LT((gathered(whole) - picture).cwiseAbs().maxCoeff(), 1e-5F * picture.maxCoeff());
  const Image shown = render(part.mesh, part.visibility, part.solution.radiosity, camera, options);
  EXPECT_GT(shown.values.minCoeff(), 0);
}

// The box is open to both sides, to surroundings that its part sees beside all images.
TEST_F(SymmetricStudy, EighthSeesTheEnvironmentOfTheWhole) {
  const Scene scene = read(R"("unit": "m", "bands": "grey", "materials": {
      "warm": {"emissivity": 0.8, "temperature": 400},
      "plain": {"emissivity": 0.5, "adiabatic": true}},
      "environment": {"temperature": 290},
      "surfaces": [
      {"name": "warm", "material": "warm",
       "polygons": [[[1, 0, 0], [1, 0, 1], [1, 1, 1], [1, 1, 0]]]},
      {"name": "plain", "material": "plain",
       "polygons": [[[0, 1, 0], [1, 1, 0], [1, 1, 1], [0, 1, 1]]]}],
      "symmetry": {"mirror": ["x=0", "y=0", "z=0"]})");
  const study::Study part = study::run(scene, few_patches());
  ASSERT_EQ(part.mesh.images.size(), 7U);
  const study::Study whole = whole_study(part);
  const Index n = part.mesh.size();
  const double black = kStefanBoltzmann * std::pow(290, 4);
  for (Index g = 0; g < 8; ++g) {
    // Shares of what is seen are off by the factors' tolerance, 1e-7, in both.
    EXPECT_LT((whole.solution.incident.middleRows(g * n, n) - part.solution.incident)
                  .cwiseAbs()
                  .maxCoeff(),
              1e-6 * black);
    EXPECT_LT((whole.solution.radiosity.middleRows(g * n, n) - part.solution.radiosity).norm(),
              2e-6 * part.solution.radiosity.norm())
        << g;
  }
  const EnergyBalance& energy = part.solution.energy;
  EXPECT_GT(energy.incident[0], 0);
  EXPECT_NEAR(energy.emitted[0] + energy.incident[0], energy.absorbed[0] + energy.escaped[0],
              1e-6 * energy.emitted[0]);
  EXPECT_GT(part.solution.temperature.minCoeff(), 290);
  EXPECT_LT(part.solution.temperature.maxCoeff(), 400 + 1e-4);
}

TEST_F(SymmetricStudy, WritesWhatItReads) {
  const Scene scene = quarter(
      R"({"mirror": ["x=0"], "rotation": {"axis": [1, 0, 0], "folds": 2},
          "translation": [[0, 3, 0]], "cut_off": 7})");
  ASSERT_EQ(scene.symmetry.translations.size(), 1U);
  EXPECT_EQ(scene.symmetry.translations[0].n_images, 3);  // to 9 m
  const auto path = folder() / "again.json";
  io::write_scene(path, scene);
  const Scene again = io::read_scene(path);
  EXPECT_EQ(study::geometry_fingerprint(again), study::geometry_fingerprint(scene));
  EXPECT_NE(study::geometry_fingerprint(again),
            study::geometry_fingerprint(quarter(R"({"mirror": ["x=0"]})")));
}

TEST_F(SymmetricStudy, RefusesWhatOverlaps) {
  test::expect_contains(error_of(quarter(R"({"mirror": ["x=0.5"]})")),
                        "surface 'floor', polygon 0: a mirror plane, through (0.5, 0, 0), cuts it");
  test::expect_contains(error_of(quarter(R"({"rotation": {"axis": [0, 0, 1], "folds": 5}})")),
                        "overlaps an image of surface");
  test::expect_contains(error_of(quarter(R"({"translation": [[0.7, 0, 0]], "images": 2})")),
                        "overlaps an image of surface");
  EXPECT_EQ(error_of(quarter(R"({"rotation": {"axis": [0, 0, 1], "folds": 4}})")), "");
  test::expect_contains(
      error_of(quarter(R"({"mirror": ["x=0"]})"), {.transport = TransportKind::compressed}),
      "do not know the scene's symmetry: use --transport dense");
}

TEST_F(SymmetricStudy, TellsWhatIsCutOff) {
  std::vector<std::string> warnings;
  const study::StudyEvents events{
      .warned = [&](const std::string& text) { warnings.push_back(text); }};
  study::run(quarter(R"({"mirror": ["x=0"], "translation": [[0, 1, 0]], "images": 20})"),
             few_patches(), events);
  bool is_told = false;
  for (const std::string& warning : warnings) {
    is_told |= warning.find("the repeated scene is cut off") != std::string::npos;
  }
  EXPECT_TRUE(is_told);
}

}  // namespace
