// The pipeline from a scene to its light, its guard over memory, and what it tells on its way.
#include "study/study.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "io/scene/scene_file.h"
#include "meshing/patches/patches.h"
#include "radiosity/assembly/dense_memory.h"
#include "radiosity/base/error.h"
#include "radiosity/compressed/make_transport.h"
#include "radiosity/scene/radiometry.h"
#include "radiosity/solve/solve.h"

namespace {

using namespace radiosity;

Scene room() { return io::read_scene(RADIOSITY_SCENES "/l-room.json"); }

/// Warnings, and how often patches were told of.
struct Told {
  std::vector<std::string> warnings;
  int n_divided = 0;

  study::StudyEvents events() {
    return {.warned = [this](const std::string& text) { warnings.push_back(text); },
            .divided = [this](const Scene&, const study::Patches&) { ++n_divided; }};
  }
};

std::string refusal(const Scene& scene, const study::StudyOptions& options, Told& told) {
  try {
    study::run(scene, options, told.events());
    return "";
  } catch (const SolveError& error) {
    return error.what();
  }
}

TEST(Study, IsTheStagesOneByOne) {
  const Scene scene = room();
  const study::Study solved = study::run(scene, {.patches = {.n_patches = 300}});
  const PatchMesh mesh = meshing::make_patches(scene, {.n_patches = 300});
  const Visibility visibility(mesh);
  const auto transport =
      make_transport(mesh, visibility, {.closed = study::closedness(scene, Closed::automatic)});
  const Solution solution = solve(*transport, exitance(scene, mesh), reflectance(scene, mesh));
  ASSERT_EQ(solved.mesh.size(), mesh.size());
  EXPECT_EQ(solved.solution.radiosity, solution.radiosity);
  EXPECT_FALSE(solved.refinement);
  // Its errors have the size of the patches in them.
  EXPECT_TRUE((solved.solution.radiosity_error.array() >= solution.radiosity_error.array()).all());
  EXPECT_GT(solved.solution.radiosity_error.norm(), solution.radiosity_error.norm());
}

TEST(Study, RefinesWhereAsked) {
  const study::Study coarse =
      study::assemble(room(), {.patches = {.n_patches = 300, .adaptive = true}, .tolerance = 0.1});
  ASSERT_TRUE(coarse.refinement);
  EXPECT_EQ(coarse.transport->size(), coarse.mesh.size());
  EXPECT_EQ(coarse.solution.radiosity.size(), 0);
}

TEST(Study, AsksBeforeTheLongWork) {
  study::StudyEvents refusing;
  refusing.divided = [](const Scene& scene, const study::Patches& patches) {
    EXPECT_EQ(patches.mesh.n_polygons(), scene.n_polygons());
    throw std::domain_error("not these");
  };
  refusing.progress.report = [](std::string_view stage, double, double, std::string_view) {
    EXPECT_NE(stage, "form factors");
  };
  EXPECT_THROW(study::run(room(), {.patches = {.n_patches = 300}}, refusing), std::domain_error);
}

TEST(Study, TheScenesWordOnBeingClosedCountsUnlessAnotherIsSaid) {
  Scene scene;
  for (const Closed asked : {Closed::no, Closed::yes, Closed::automatic}) {
    scene.closed.reset();
    EXPECT_EQ(study::closedness(scene, asked), asked);
    for (const bool is_closed : {false, true}) {
      scene.closed = is_closed;
      const Closed said = is_closed ? Closed::yes : Closed::no;
      EXPECT_EQ(study::closedness(scene, asked), asked == Closed::automatic ? said : asked);
    }
  }
}

TEST(Study, RefusesWhatDoesNotFitBeforeAnyPatchIsMade) {
  const Scene scene = room();
  for (const meshing::PatchChoice& choice :
       {meshing::PatchChoice{.n_patches = 1'000'000}, meshing::PatchChoice{.max_edge = 1e-3}}) {
    Told told;
    const std::string text =
        refusal(scene, {.patches = choice, .memory = dense_transport_bytes(500)}, told);
    EXPECT_NE(text.find("use --patches 500"), std::string::npos) << text;
    EXPECT_EQ(told.n_divided, 0);
  }
  Told told;
  const std::string text =
      refusal(scene, {.patches = {.as_is = true}, .memory = dense_transport_bytes(10)}, told);
  EXPECT_NE(text.find("fewer polygons"), std::string::npos) << text;
}

TEST(Study, OnDiskMemoryIsForThePatchesOnly) {
  const study::StudyOptions dense{.patches = {.n_patches = 400}, .memory = 300'000};
  EXPECT_THROW(study::divide(room(), dense), SolveError);
  study::StudyOptions streamed = dense;
  streamed.storage = study::Storage::disk;
  EXPECT_THROW(study::divide(room(), streamed), SolveError);
  streamed.memory = 200'000'000;
  EXPECT_GT(study::divide(room(), streamed).mesh.size(), 300);
}

TEST(Study, WarnsOfDarkness) {
  Scene scene = room();
  for (Material& material : scene.materials) material.emission = {};
  Told told;
  const study::Study dark = study::run(scene, {.patches = {.n_patches = 100}}, told.events());
  EXPECT_EQ(told.n_divided, 1);
  EXPECT_TRUE(dark.solution.radiosity.isZero(0));
  ASSERT_FALSE(told.warnings.empty());
  EXPECT_EQ(told.warnings.front().rfind("no surface emits light", 0), 0U);
}

TEST(LeastPatches, AreNeverMoreThanThereAre) {
  const Scene scene = room();
  for (const meshing::PatchOptions& options :
       {meshing::PatchOptions{}, meshing::PatchOptions{.max_edge = 0.5},
        meshing::PatchOptions{.max_edge = 0.3}, meshing::PatchOptions{.max_edge = 10}}) {
    EXPECT_LE(meshing::least_patches(scene, options), meshing::make_patches(scene, options).size());
  }
}

}  // namespace
