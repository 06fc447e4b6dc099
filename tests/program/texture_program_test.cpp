// Scenes with textures, as a user would run them.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "tests/support/messages.h"
#include "tests/support/program.h"

namespace {

using namespace radiosity::test;
using Json = nlohmann::json;

/// A PNG of two pixels, black and white, in a data URI.
constexpr const char* kBlackWhite =
    "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAIAAAABCAAAAADRSSBWAAAAC0lEQVR4nGNg+A8AAQIBAEK+"
    "vGgAAAAASUVORK5CYII=";
/// Four corners of a square of 2 m, (0, 0) to (2, 2), their texture coordinates and two triangles.
constexpr const char* kSquare =
    "data:application/"
    "octet-stream;base64,AAAAAAAAAAAAAAAAAAAAQAAAAAAAAAAAAAAAQAAAAEAAAAAAAAAAAAAAAEAA"
    "AAAAAAAAAAAAgD8AAIA/AACAPwAAgD8AAAAAAAAAAAAAAAAAAQIAAgM=";

class Textures : public Program {
 protected:
  /// A floor, the left half of which is black and the right one white, below a luminaire.
  [[nodiscard]] std::string write_floor() const {
    (void)write_file("ball.ies",
                     "IESNA91\nTILT=NONE\n1 -1 100 2 1 1 2 0 0 0\n1 1 10\n0 180\n0\n1 1\n");
    const Json gltf = {
        {"asset", {{"version", "2.0"}}},
        {"buffers", {{{"byteLength", 86}, {"uri", kSquare}}}},
        {"bufferViews",
         {{{"buffer", 0}, {"byteOffset", 0}, {"byteLength", 48}},
          {{"buffer", 0}, {"byteOffset", 48}, {"byteLength", 32}},
          {{"buffer", 0}, {"byteOffset", 80}, {"byteLength", 6}}}},
        {"accessors",
         {{{"bufferView", 0}, {"componentType", 5126}, {"count", 4}, {"type", "VEC3"}},
          {{"bufferView", 1}, {"componentType", 5126}, {"count", 4}, {"type", "VEC2"}},
          {{"bufferView", 2}, {"componentType", 5121}, {"count", 6}, {"type", "SCALAR"}}}},
        {"images", {{{"uri", kBlackWhite}}}},
        {"textures", {{{"source", 0}}}},
        {"materials",
         {{{"name", "paint"}, {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}}},
        {"meshes",
         {{{"primitives",
            {{{"attributes", {{"POSITION", 0}, {"TEXCOORD_0", 1}}},
              {"indices", 2},
              {"material", 0}}}}}}},
        {"nodes", {{{"mesh", 0}}}},
        {"scenes", {{{"nodes", {0}}}}},
        {"scene", 0}};
    (void)write_file("floor.gltf", gltf.dump());
    return write_file("floor.json", R"({"surfaces": [{"name": "floor", "mesh": "floor.gltf"}],
        "luminaires": [{"name": "l", "file": "ball.ies", "position": [1, 1, 1.5]}]})");
  }
};

// The light is the same on both halves, of which one takes it and the other sends it back: so does
// half of all of it, however the floor is divided.
TEST_F(Textures, SendBackTheirShare) {
  const std::string scene = write_floor();
  const auto solve = [&](Arguments more) {
    more.insert(more.begin(), {"solve", scene, "--json", "--quiet"});
    const Outcome outcome = run(more);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return Json::parse(outcome.out);
  };
  const auto warnings = [](const Json& json) { return json["warnings"].dump(); };
  for (const char* patches : {"2", "8", "50"}) {
    const Json energy = solve({"--patches", patches})["energy"];
    for (std::size_t band = 0; band < 3; ++band) {
      const double incident = energy["incident"][band];
      EXPECT_NEAR(energy["escaped"][band].get<double>(), incident / 2, 1e-9 * incident);
      EXPECT_NEAR(energy["absorbed"][band].get<double>(), incident / 2, 1e-9 * incident);
    }
  }
  expect_contains(warnings(solve({"--as-is"})), "textures vary within patches");
  EXPECT_EQ(warnings(solve({"--adaptive"})).find("textures"), std::string::npos);
  // The material's own figure is the mean; a scenario paints it evenly.
  EXPECT_NEAR(Json::parse(run({"inspect", scene, "--json"}).out)["surfaces"][0]["reflectance"][0]
                  .get<double>(),
              0.5, 1e-12);
}

}  // namespace
