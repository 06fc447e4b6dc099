// Pictures as `render` and `solve` make them: camera, false colours, and what they refuse.

#include <gtest/gtest.h>
#include <png.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/program.h"

namespace {

using namespace radiosity::test;
using Json = nlohmann::json;

class Pictures : public Program {
 protected:
  /// A lit room of 2 x 2 x 2 m with a solid block of 0.5 m on the floor; `members`: more of it.
  std::string write_room(const std::string& members = "", const std::string& name = "room") const {
    const auto box = [](const std::string& surface, double low, double high, double top,
                        bool solid) {
      std::ostringstream text;
      const std::vector<std::vector<int>> faces = {{0, 1, 3, 2}, {4, 6, 7, 5}, {0, 4, 5, 1},
                                                   {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 5, 7, 3}};
      text << R"({"name": ")" << surface << R"(", "material": "wall", "vertices": [)";
      for (int k = 0; k < 8; ++k) {
        text << (k > 0 ? ", [" : "[") << (k / 4 == 0 ? low : high) << ", "
             << (k / 2 % 2 == 0 ? 0.01 : top) << ", " << (k % 2 == 0 ? low : high) << ']';
      }
      text << R"(], "polygons": [)";
      for (std::size_t f = 0; f < faces.size(); ++f) {
        std::vector<int> face = faces[f];
        if (!solid) std::reverse(face.begin(), face.end());
        text << (f > 0 ? ", [" : "[") << face[0] << ", " << face[1] << ", " << face[2] << ", "
             << face[3] << ']';
      }
      text << "]}";
      return text.str();
    };
    return write_file(name + ".json",
                      "{" + members +
                          R"("materials": {"wall": {"reflectance": 0.5, "radiance": 1}},
                             "surfaces": [)" +
                          box("room", 0, 2, 2, false) + ", " + box("block", 0.7, 1.2, 0.5, true) +
                          "]}");
  }
  Outcome render(const std::string& scene, Arguments arguments, const char* name = "a.png") const {
    const Arguments start = {"render",  scene, "--patches", "100", "-o",     result(name),
                             "--width", "48",  "--height",  "32",  "--quiet"};
    arguments.insert(arguments.begin(), start.begin(), start.end());
    return run(arguments);
  }
  /// The bytes of the picture that comes out.
  std::string picture(const std::string& scene, const Arguments& arguments) const {
    const Outcome outcome = render(scene, arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return contents(result("a.png"));
  }
};

std::pair<unsigned, unsigned> png_size(const std::string& png) {
  png_image header = {};
  header.version = PNG_IMAGE_VERSION;
  EXPECT_NE(png_image_begin_read_from_memory(&header, png.data(), png.size()), 0);
  const std::pair<unsigned, unsigned> size = {header.width, header.height};
  png_image_free(&header);
  return size;
}

TEST_F(Pictures, TakeTheCameraFromTheOptions) {
  const std::string with_camera = write_room(R"("camera": {"position": [0.2, 1.6, 0.3],
      "look_at": [1, 0.5, 1.5], "up": [0, 1, 0.1], "vertical_fov_deg": 70}, )");
  const std::string without = write_room("", "bare");
  const std::string expected = picture(with_camera, {});
  EXPECT_EQ(picture(without, {"--camera-position", "0.2,1.6,0.3", "--look-at", "1,0.5,1.5", "--up",
                              "0,1,0.1", "--fov", "70"}),
            expected);
  EXPECT_EQ(picture(without, {"--camera-position=0.2,1.6,0.3", "--camera-direction=0.8,-1.1,1.2",
                              "--up", "0,10,1", "--fov=70"}),
            expected);
  // Any part alone replaces the scene's.
  EXPECT_EQ(picture(with_camera, {"--look-at", "1,0.5,1.5"}), expected);
  EXPECT_NE(picture(with_camera, {"--fov", "40"}), expected);
  EXPECT_NE(picture(with_camera, {"--camera-position", "0.3,1.6,0.3"}), expected);
  EXPECT_NE(picture(with_camera, {"--up", "1,0,0"}), expected);
  // So does a view, whose parts can be replaced in turn.
  const std::string with_views = write_room(R"("views": {"low": {"position": [1.8, 0.2, 0.2],
      "direction": [0, 0, 1]}, "high": {"position": [0.2, 1.6, 0.3], "look_at": [1, 0.5, 1.5],
      "up": [0, 1, 0.1], "vertical_fov_deg": 70}}, )",
                                            "views");
  EXPECT_EQ(picture(with_views, {"--view", "high"}), expected);
  EXPECT_NE(picture(with_views, {"--view", "low"}), expected);
  EXPECT_EQ(picture(with_views, {"--view", "low", "--camera-position", "0.2,1.6,0.3", "--look-at",
                                 "1,0.5,1.5", "--up", "0,1,0.1", "--fov", "70"}),
            expected);
  const Outcome unknown = render(with_views, {"--view", "door"});
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_NE(unknown.err.find("no view is called 'door'; there are 'low', 'high'"),
            std::string::npos)
      << unknown.err;
  // Straight down, where the usual up says nothing.
  picture(without, {"--camera-position", "1,1.9,1", "--camera-direction", "0,-1,0"});
}

TEST_F(Pictures, WithoutAPositionSeeTheSceneFromOutside) {
  const Outcome outcome = render(write_room(), {"--camera-direction", "1,0,0", "--fov", "20"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_NE(outcome.err.find("no camera"), std::string::npos) << outcome.err;
  EXPECT_EQ(outcome.err.find("inside a solid"), std::string::npos) << outcome.err;
}

TEST_F(Pictures, RefuseImpossibleOptions) {
  const std::string scene = write_room();
  const std::vector<std::pair<Arguments, std::string>> cases = {
      {{"--width", "0"}, "--width"},
      {{"--width", "-5"}, "--width"},
      {{"--height", "1000000", "--width", "1000000"}, "not in range"},
      {{"--height", "2.5"}, "--height"},
      {{"--samples", "0"}, "square number"},
      {{"--exposure", "-1"}, "above 0"},
      {{"--fov", "180"}, "between 0 and 180 degrees"},
      {{"--camera-position", "1,2"}, "three numbers x,y,z"},
      {{"--camera-position", "1,2,nan"}, "three numbers x,y,z"},
      {{"--camera-direction", "0,0,0"}, "not all 0"},
      {{"--look-at", "1,1,1", "--camera-direction", "0,0,1"}, "--camera-direction"},
      {{"--camera-position", "1,1,1", "--look-at", "1,1,1"}, "is the camera's position"},
      {{"--camera-direction", "0,1,0", "--up", "0,-2,0"}, "parallel to the viewing direction"},
      {{"--false-colour", "brightness"}, "expected one of radiance"},
      {{"--range", "0,1"}, "--false-colour"},
      {{"--false-colour", "luminance", "--range", "2,1"}, "two numbers LO,HI"},
      {{"--false-colour", "luminance", "--range", "0,1", "--log"}, "both ends must be above 0"},
      {{"--false-colour", "luminance", "--band", "0"}, "luminance has no bands"},
      {{"--false-colour", "radiance", "--band", "3"}, "the scene's bands are 0 to 2"},
      {{"--false-colour", "radiance", "--band", "-1"}, "a whole number from 0"},
      {{"--false-colour", "radiance", "--exposure", "1"}, "--exposure"}};
  for (const auto& [arguments, words] : cases) {
    SCOPED_TRACE(testing::PrintToString(arguments));
    expect_error(render(scene, arguments), 2, words);
  }
  EXPECT_TRUE(results().empty());
}

TEST_F(Pictures, ThatWouldBeEmptyAreErrors) {
  const std::string scene = write_room();
  const Arguments away = {"--camera-position", "-3,1,1", "--camera-direction", "-1,0,0"};
  expect_error(render(scene, away), 1,
               "the camera at (-3, 1, 1) m looks in direction (-1, 0, 0), past the scene, which "
               "lies between (0, 0.01, 0) and (2, 2, 2) m");
  const std::string square = write_file("square.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n");
  expect_error(render(square, {"--camera-position", "0.5,0.5,-2", "--look-at", "0.5,0.5,0"}), 1,
               "only backs of one-sided surfaces before it");
  expect_error(render(square, {"--camera-position", "0.5,0.5,1e5", "--look-at", "0,0,0"}), 1,
               "smaller than a pixel");
  expect_error(run({"solve", scene, "-o", result("a.csv"), "-o", result("a.png"),
                    "--camera-position", "-3,1,1", "--camera-direction", "-1,0,0"}),
               1, "the picture would be empty");
  EXPECT_TRUE(results().empty());
}

TEST_F(Pictures, FromInsideASolidComeWithAWarning) {
  const std::string scene = write_room();
  const Outcome inside = render(scene, {"--camera-position", "0.9,0.3,0.9", "--look-at", "0,1,2"});
  EXPECT_EQ(inside.exit_code, 0);
  EXPECT_NE(inside.err.find("is inside a solid or a wall: backs of one-sided surfaces are all "
                            "around it, nearest 'block'"),
            std::string::npos)
      << inside.err;
  // Looking into the closed room from outside, or standing in it, is what one wants.
  for (const char* position : {"-0.001,1,1", "-5,8,1", "0.2,1.5,0.2"}) {
    const Outcome outcome = render(scene, {"--camera-position", position, "--look-at", "1,1,1"});
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_EQ(outcome.err, "") << position;
  }
}

TEST_F(Pictures, InFalseColorsTellTheirScale) {
  const std::string scene = write_room();
  const Outcome outcome = render(
      scene, {"--camera-position", "0.2,1.5,0.2", "--false-colour", "illuminance", "--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const Json shown = Json::parse(outcome.out)["false_colour"];
  EXPECT_EQ(shown["quantity"], "illuminance");
  EXPECT_EQ(shown["unit"], "lux");
  // H = 2 π W/m² in each band of the furnace, within the tolerance of 1e-2.
  EXPECT_LE(shown["low"].get<double>(), 1.01 * 2 * M_PI * 179);
  EXPECT_GE(shown["high"].get<double>(), 0.99 * 2 * M_PI * 179);
  const auto [width, height] = png_size(contents(result("a.png")));
  EXPECT_EQ(height, 32U);
  EXPECT_GT(width, 48U + 40U);  // the bar is added

  const Outcome text = render(scene, {"--camera-position", "0.2,1.5,0.2", "--false-color",
                                      "radiance", "--band", "1", "--range", "0.5,4", "--log"});
  EXPECT_NE(text.out.find("radiance from 0.5 to 4 W/(m² sr), logarithmic"), std::string::npos)
      << text.out;
  EXPECT_EQ(render(scene, {"--false-colour", "error"}, "a.exr").exit_code, 0);

  const std::string viridis = contents(result("a.png"));
  EXPECT_EQ(render(scene, {"--false-colour", "irradiance", "--colour-map", "inferno"}).exit_code,
            0);
  EXPECT_NE(contents(result("a.png")), viridis);
  const Outcome unknown = render(scene, {"--false-colour", "irradiance", "--color-map", "jet"});
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_NE(unknown.err.find("viridis, inferno, cividis, grey, diverging"), std::string::npos)
      << unknown.err;
}

TEST_F(Pictures, CanBeGathered) {
  const std::string scene = write_room();
  const Arguments camera = {"--camera-position", "0.2,1.5,0.2", "--look-at", "1,0,1"};
  Arguments gathered = camera;
  gathered.emplace_back("--gather");
  const std::string interpolated = picture(scene, camera);
  const std::string exact = picture(scene, gathered);
  EXPECT_EQ(png_size(exact), png_size(interpolated));
  EXPECT_NE(exact, interpolated);
  gathered.insert(gathered.end(), {"--false-colour", "illuminance"});
  EXPECT_EQ(render(scene, gathered).exit_code, 2);
}

TEST_F(Pictures, LightmapsGoToGlbAndAtlas) {
  const std::string scene = write_room();
  const Outcome outcome =
      run({"solve", scene, "--patches", "100", "--lightmap", "--lightmap-size", "64", "--atlas",
           result("a.exr"), "--atlas", result("a.png"), "-o", result("a.glb"), "--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(results(), (std::vector<std::string>{"a.exr", "a.glb", "a.png"}));
  EXPECT_EQ(Json::parse(outcome.out)["outputs"].size(), 3U);
  const std::string glb = contents(result("a.glb"));
  EXPECT_NE(glb.find("TEXCOORD_0"), std::string::npos);
  EXPECT_NE(glb.find(contents(result("a.png"))), std::string::npos);
}

TEST_F(Pictures, LightmapsThatNothingWouldShowAreRefused) {
  const std::string scene = write_room();
  expect_error(run({"solve", scene, "--lightmap", "-o", result("a.ply")}), 2, "--atlas");
  expect_error(run({"solve", scene, "--atlas", result("a.png")}), 2, "--lightmap");
  expect_error(run({"solve", scene, "--lightmap", "--atlas", result("a.glb")}), 2, ".exr");
  // Before the long work.
  std::string triangles;
  for (int k = 0; k < 17; ++k) {
    const std::string z = std::to_string(k);
    triangles += "v 0 0 " + z + "\nv 1 0 " + z + "\nv 0 1 " + z + "\nf -3 -2 -1\n";
  }
  const Outcome outcome = run({"solve", write_file("many.obj", triangles), "--lightmap",
                               "--lightmap-size", "16", "-o", result("a.glb"), "--quiet"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_NE(outcome.err.find("a lightmap of 16 x 16 texels has no room for 17 polygons"),
            std::string::npos)
      << outcome.err;
  EXPECT_TRUE(results().empty());
}

}  // namespace
