// Form factors that are used again: for what they are right, and why they are refused.
#include "study/known_factors.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "io/scene/scene_file.h"
#include "radiosity/base/error.h"
#include "study/study.h"

namespace {

using namespace radiosity;

Scene known_room() { return io::read_scene(RADIOSITY_SCENES "/l-room.json"); }

const study::StudyOptions kKnownOptions{.patches = {.n_patches = 300}};

study::KnownFactors known_factors(const Scene& scene,
                                  const study::StudyOptions& options = kKnownOptions) {
  study::Study assembled = study::assemble(scene, options);
  return {.source = "o.h5",
          .mesh = std::move(assembled.mesh),
          .transport = std::move(assembled.transport),
          .tolerance = assembled.factor_tolerance,
          .geometry = study::geometry_fingerprint(scene)};
}

std::string refusal(const Scene& scene, const study::StudyOptions& options) {
  static const study::KnownFactors known = known_factors(known_room());
  try {
    study::check_known(scene, known, options, {});
    return "";
  } catch (const SolveError& error) {
    return error.what();
  }
}

/// The room with other light and other walls.
Scene repainted() {
  Scene scene = known_room();
  for (Material& material : scene.materials) {
    material.reflectance *= 0.5;
    if (material.emission.kind != Emission::Kind::none) material.emission.value *= 3;
  }
  return scene;
}

TEST(KnownFactors, ServeOtherLightAndReflectances) {
  const Scene scene = repainted();
  const study::Study anew = study::run(scene, kKnownOptions);
  const study::Study again =
      study::with_light(study::assemble(scene, known_factors(known_room())), {});
  EXPECT_EQ(again.solution.radiosity, anew.solution.radiosity);
  EXPECT_EQ(again.solution.radiosity_error, anew.solution.radiosity_error);
  EXPECT_EQ(again.factor_tolerance, anew.factor_tolerance);
  EXPECT_EQ(again.mesh.corners, anew.mesh.corners);
}

TEST(KnownFactors, TellTheirPatchesBeforeTheLongWork) {
  int n_divided = 0;
  study::StudyEvents events;
  events.divided = [&](const Scene&, const study::Patches& patches) {
    ++n_divided;
    EXPECT_GT(patches.mesh.size(), 200);
  };
  study::assemble(known_room(), known_factors(known_room()), {}, events);
  EXPECT_EQ(n_divided, 1);
}

TEST(KnownFactors, AreRefusedWithTheReason) {
  EXPECT_EQ(refusal(known_room(), {}), "");
  EXPECT_EQ(refusal(known_room(), kKnownOptions), "");
  EXPECT_NE(refusal(known_room(), {.patches = {.n_patches = 100}}).find("patches"),
            std::string::npos);
  EXPECT_NE(refusal(known_room(), {.closed = Closed::no}).find("closed"), std::string::npos);

  Scene other = known_room();
  other.surfaces[0].name = "carpet";
  EXPECT_NE(refusal(other, {}).find("'carpet'"), std::string::npos);
  other = known_room();
  other.surfaces.push_back({"shelf"});
  EXPECT_NE(refusal(other, {}).find("surfaces"), std::string::npos);
  other = known_room();
  other.add_polygon(other.polygon(0), 0);
  EXPECT_NE(refusal(other, {}).find("polygons"), std::string::npos);
  other = known_room();
  other.vertices[0].x() += 1e-3;
  EXPECT_NE(refusal(other, {}).find("other polygons"), std::string::npos);
  other = known_room();
  other.precision = 1e-3;
  EXPECT_NE(refusal(other, {}).find("precision"), std::string::npos);
}

TEST(KnownFactors, TellThatMoreIsAsked) {
  std::vector<std::string> warnings;
  study::StudyEvents events;
  events.warned = [&](const std::string& text) { warnings.push_back(text); };
  study::check_known(known_room(), known_factors(known_room()), {.tolerance = 1e-3}, events);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].find("o.h5"), std::string::npos) << warnings[0];
}

}  // namespace
