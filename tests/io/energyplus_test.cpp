// Scenes of EnergyPlus: .idf and .epJSON.

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "radiosity/base/geometry.h"
#include "tests/support/scratch_files.h"

namespace {

using radiosity::Index;
using radiosity::Scene;
using radiosity::Vec3;

class EnergyPlus : public ScratchFiles {};

/// Vector area of each surface, by its name.
std::map<std::string, Vec3> areas(const Scene& scene) {
  std::map<std::string, Vec3> result;
  for (Index i = 0; i < scene.n_polygons(); ++i) {
    std::vector<Vec3> corners;
    for (const auto v : scene.polygon(i)) corners.push_back(scene.vertices[v]);
    auto [entry, is_new] =
        result.try_emplace(scene.surfaces[scene.polygon_surface[i]].name, Vec3::Zero());
    entry->second += radiosity::vector_area(corners);
  }
  return result;
}

std::string head(const std::string& rules = "UpperLeftCorner, Counterclockwise, Relative") {
  return "GlobalGeometryRules, " + rules + ";\nZone, Office, 0, 1, 2, 3;\n" +
         "Material, Plaster, Smooth, .02, .6, 1200, 1000, 0.8;\nConstruction, Wall, Brick, "
         "Plaster;\n";
}

std::string wall(const std::string& name, const std::string& corners,
                 const std::string& zone = "OFFICE") {
  return "BuildingSurface:Detailed, " + name + ", Wall, wall, " + zone +
         ", , Outdoors, , SunExposed, WindExposed, 0.5, , " + corners + ";\n";
}

std::string window(const std::string& name, const std::string& corners,
                   const std::string& more = ", 0.5, , 1, 4") {
  return "FenestrationSurface:Detailed, " + name + ", Window, Glass, Front, " + more + ", " +
         corners + ";\n";
}

// Seen from outside, from below and from the left: the front is at y = 0.
const std::string kFront = "0,0,3, 0,0,0, 4,0,0, 4,0,3";

TEST_F(EnergyPlus, WallsFaceTheirZonesWithoutTheirWindows) {
  const Scene scene =
      read("a.idf", head() + wall("Front", kFront) + window("W1", "1,0,2, 1,0,1, 2,0,1, 2,0,2") +
                        window("W2", "2.5,0,2, 2.5,0,0, 3.5,0,0, 3.5,0,2"));
  ASSERT_EQ(scene.surfaces.size(), 3U);
  const auto area = areas(scene);
  EXPECT_NEAR((area.at("W1") - Vec3(0, 1, 0)).norm(), 0, 1e-12);  // into the zone
  EXPECT_NEAR((area.at("W2") - Vec3(0, 2, 0)).norm(), 0, 1e-12);
  EXPECT_NEAR((area.at("Front") - Vec3(0, 12 - 3, 0)).norm(), 0, 1e-9);
  for (const Vec3& v : scene.vertices) {
    EXPECT_EQ(v.y(), 2);
    EXPECT_GE(v.x(), 1);
    EXPECT_LE(v.x(), 5);
    EXPECT_GE(v.z(), 3);
  }
  EXPECT_EQ(scene.bands.kind, radiosity::Bands::Kind::grey);
  EXPECT_NEAR(scene.materials[scene.surfaces[0].material].reflectance[0], 0.2, 1e-12);
  EXPECT_NEAR(scene.materials[scene.surfaces[1].material].reflectance[0], 0.1, 1e-12);  // unknown
}

TEST_F(EnergyPlus, RulesAndZonesMoveAndTurn) {
  const auto front = [&](const std::string& rules, const std::string& zone) {
    return areas(read("a.idf", "GlobalGeometryRules, " + rules + ";\nZone, Office, " + zone +
                                   ";\nConstruction, Wall, X;\n" + wall("Front", kFront)))
        .at("Front");
  };
  EXPECT_NEAR((front("U, Counterclockwise, World", "90, 5, 5, 5") - Vec3(0, 12, 0)).norm(), 0,
              1e-12);
  EXPECT_NEAR((front("U, Clockwise, Relative", "0, 5, 5, 5") - Vec3(0, -12, 0)).norm(), 0, 1e-12);
  // A zone whose north is 90 degrees from the building's by the clock has its +y towards +x.
  EXPECT_NEAR((front("U, Counterclockwise, Relative", "90, , ,") - Vec3(12, 0, 0)).norm(), 0,
              1e-12);
}

// A gable of five corners, and a wall round a corner, which is not convex.
TEST_F(EnergyPlus, WallsOfAnyOutline) {
  const Scene scene = read(
      "a.idf", head() + wall("Front", "0,0,3, 0,0,0, 4,0,0, 4,0,3, 2,0,5") +
                   window("W", "1.5,0,4, 1.5,0,3.5, 2.5,0,3.5, 2.5,0,4") +
                   wall("Back", "4,8,3, 4,8,0, 0,8,0, 0,8,3") +
                   wall("Bent", "0,4,3, 0,4,0, 4,4,0, 4,4,1, 1,4,1, 1,4,3") +
                   "FenestrationSurface:Detailed, Low, Door, Glass, Bent, , 0.5, , 1, 3, 2,4,0.8, "
                   "2,4,0.2, 3,4,0.2;\n");
  const auto area = areas(scene);
  EXPECT_NEAR(area.at("Front").y(), 12 + 4 - 0.5, 1e-9);
  EXPECT_NEAR(area.at("Low").y(), 0.3 * 0.6 / 0.6, 1e-9);
  EXPECT_NEAR(area.at("Bent").y(), 4 + 2 - 0.3, 1e-9);
  EXPECT_NEAR(area.at("Back").y(), -12, 1e-12);
}

TEST_F(EnergyPlus, OlderFilesHaveNoSpacesAndAShadingControl) {
  const Scene scene =
      read("a.idf", head() +
                        "BuildingSurface:Detailed, Front, Wall, Wall, Office, Outdoors, , "
                        "SunExposed, WindExposed, 0.5, 4, " +
                        kFront +
                        ";\nWall:Detailed, Side, Wall, Office, , Adiabatic, , NoSun, NoWind, "
                        "0, 3, 0,0,0, 0,1,0, 0,0,1;\n" +
                        window("W", "1,0,2, 1,0,1, 2,0,1, 2,0,2", ", 0.5, Blind, , 1, 4"));
  EXPECT_NEAR(areas(scene).at("Front").y(), 11, 1e-9);
  EXPECT_EQ(scene.surfaces.size(), 3U);
}

/// Keys with the prefix and the axis, and what they hold.
std::string coordinates(const std::string& prefix, const Vec3& at) {
  std::string text;
  for (int axis = 0; axis < 3; ++axis) {
    text += std::string(axis > 0 ? ", " : "") + '"' + prefix + "xyz"[axis] +
            "_coordinate\": " + std::to_string(at[axis]);
  }
  return text;
}

std::string corner(double x, double y, double z) {
  return "{" + coordinates("vertex_", {x, y, z}) + "}";
}

std::string front_in_json(const std::string& more = "") {
  return R"({"GlobalGeometryRules": {"r": {"starting_vertex_position": "UpperLeftCorner",
      "vertex_entry_direction": "Counterclockwise", "coordinate_system": "Relative"}},
    "Zone": {"Office": {"x_origin": 1, "y_origin": 2, "z_origin": 3}},
    "Material": {"Plaster": {"thermal_absorptance": 0.8}},
    "Construction": {"Wall": {"outside_layer": "Brick", "layer_2": "Plaster"}},
    "BuildingSurface:Detailed": {"Front": {"construction_name": "Wall", "zone_name": "Office",
      "surface_type": "Wall", "vertices": [)" +
         corner(0, 0, 3) + "," + corner(0, 0, 0) + "," + corner(4, 0, 0) + "," + corner(4, 0, 3) +
         "]}}" + more + "}";
}

std::string window_in_json(const std::string& base, const std::string& more = "") {
  std::string text = R"(, "FenestrationSurface:Detailed": {"W": {"construction_name": "Glass",
      "building_surface_name": ")" +
                     base + "\"" + more;
  const Vec3 at[4] = {{1, 0, 2}, {1, 0, 1}, {2, 0, 1}, {2, 0, 2}};
  for (int k = 0; k < 4; ++k) {
    text += ", " + coordinates("vertex_" + std::to_string(k + 1) + "_", at[k]);
  }
  return text + "}}";
}

TEST_F(EnergyPlus, JsonIsTheSameAsText) {
  const Scene json = read("a.epJSON", front_in_json(window_in_json("Front")));
  const Scene text =
      read("a.idf", head() + wall("Front", kFront) + window("W", "1,0,2, 1,0,1, 2,0,1, 2,0,2"));
  EXPECT_EQ(json.vertices, text.vertices);
  EXPECT_EQ(json.corners, text.corners);
  EXPECT_EQ(json.polygon_surface, text.polygon_surface);
  ASSERT_EQ(json.surfaces.size(), text.surfaces.size());
  for (std::size_t s = 0; s < json.surfaces.size(); ++s) {
    EXPECT_EQ(json.surfaces[s].name, text.surfaces[s].name);
    EXPECT_EQ(json.materials[json.surfaces[s].material].reflectance,
              text.materials[text.surfaces[s].material].reflectance);
  }
}

TEST_F(EnergyPlus, FaultsAreTold) {
  struct Case {
    std::string text;
    std::string message;
  };
  const std::string good = head() + wall("Front", kFront);
  const std::string hole = "1,0,2, 1,0,1, 2,0,1, 2,0,2";
  const Case idf[] = {
      {"Zone, Office;\n", "has no GlobalGeometryRules"},
      {head("U, Sideways, Relative") + wall("Front", kFront), "expected Counterclockwise"},
      {head("U, Clockwise, Here") + wall("Front", kFront), "expected Relative, World"},
      {head() + "Zone, office;\n", "a.idf:5: Zone \"office\" stands twice"},
      {good + wall("FRONT", kFront), "a.idf:6: BuildingSurface:Detailed \"FRONT\" stands twice"},
      {good + window("front", hole), "stands twice"},
      {good + wall("Side", kFront, "Attic"), "is of the zone \"Attic\", which there is not"},
      {good + wall("Side", "0,0,0, 1,0"), "has 5 coordinates"},
      {good + wall("Side", "0,0,0, 1,0,0, 1,x,1"), "has a corner at \"x\""},
      {good + "FenestrationSurface:Detailed, W, Window, G, Rear, , 0.5, , 1, 4, " + hole + ";",
       "is in the surface \"Rear\", which there is not"},
      {good + window("W", hole, ", 0.5, , 3, 4"), "has the multiplier 3"},
      {good + window("W", hole, ", 0.5, , 1, 3"), "has 4 corners, and says 3"},
      {good + window("W", "1,0.1,2, 1,0.1,1, 2,0.1,1, 2,0.1,2"), "does not lie in the plane"},
      {good + window("W", "1,0,2, 2,0,2, 2,0,1, 1,0,1"), "faces the other way"},
      {good + window("W", "3,0,2, 3,0,1, 5,0,1, 5,0,2"), "reach beyond it, or overlap"},
      {good + window("W", hole) + window("V", "1.5,0,2, 1.5,0,1, 3,0,1, 3,0,2"), "or overlap"},
      {good + window("W", kFront), "is nothing but windows"},
      {good + "Window, W, Glass, Front, , 1, 1, 1, 1, 1;\n", "is given by a starting point"},
      {good + "Zone, Cellar", "expected a semicolon"},
      {good + "Zone, Cellar,", "a.idf:6: the object has no end"},
      {"##include x\n", "a.idf:1: is a macro"},
      {head(), "has no surfaces"},
      {"GlobalGeometryRules, U, Clockwise, Relative;\nConstruction:AirBoundary, Wall;\nZone, "
       "Office;\n" +
           wall("Front", kFront),
       "is a boundary of air"},
      {head() + "Material, Plastic, S, 1, 1, 1, 1, 1.5;\n" + wall("Front", kFront),
       "has the emissivity 1.5"}};
  for (const Case& each : idf) EXPECT_CONTAINS(error_of("a.idf", each.text), each.message);
  const Case json[] = {
      {"{", "a.epJSON:1:"},
      {"[]", "a.epJSON"},
      {R"({"Zone": {"A": {}, "A": {}}})", "stands twice"},
      {R"({"Zone": []})", "a.epJSON"},
      {front_in_json(window_in_json("Rear")), "which there is not"},
      {front_in_json(window_in_json("Front", ", \"multiplier\": \"two\"")), "expected a number"},
      {front_in_json(R"(, "Window": {"W": {}})"), "is given by a starting point"}};
  for (const Case& each : json) EXPECT_CONTAINS(error_of("a.epJSON", each.text), each.message);
}

}  // namespace
