#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <span>

#include "io/scene/scene_keys.h"
#include "tests/support/sample_files.h"
#include "tests/support/scratch_files.h"

namespace {

using radiosity::Bands;
using radiosity::Emission;
using radiosity::kPi;
using radiosity::Scene;
using radiosity::Vec3;

class SceneJson : public ScratchFiles {
 protected:
  /// A scene of one triangle with the given members before its surfaces and in its material.
  static std::string scene(const std::string& members,
                           const std::string& material = R"("reflectance": 0.5)") {
    return "{" + members + R"("materials": {"grey": {)" + material +
           R"(}}, "surfaces": [{"name": "floor", "material": "grey",
               "polygons": [[[0, 0, 0], [2, 0, 0], [2, 3, 0]]]}]})";
  }
  /// A scene with the given surfaces and a material "grey".
  static std::string surfaces(const std::string& list) {
    return R"({"materials": [{"name": "grey", "reflectance": 0.5}], "surfaces": [)" + list + "]}";
  }
  static std::string mesh(const std::string& members) {
    return R"({"name": "m", )" + members + "}";
  }
};

TEST_F(SceneJson, ReadsEverything) {
  (void)file("square.off", kOff);
  (void)file("spectra.csv", kCsv);
  const Scene scene = read("a.json", kJson);
  EXPECT_EQ(scene.bands.kind, Bands::Kind::wavelengths);
  EXPECT_EQ(scene.bands.wavelengths, (std::vector<double>{400, 450, 600}));
  ASSERT_EQ(scene.materials.size(), 2U);
  EXPECT_TRUE(scene.materials[0].reflectance.isApprox(Eigen::Vector3d(0.5, 0.6, 0.8), 1e-15));
  EXPECT_EQ(scene.materials[1].emission.kind, Emission::Kind::radiance);
  EXPECT_EQ(scene.materials[1].emission.value, Eigen::Vector3d(1, 2, 3));
  ASSERT_EQ(scene.surfaces.size(), 3U);
  EXPECT_EQ(scene.surfaces[2].name, "mesh");
  EXPECT_TRUE(scene.surfaces[1].two_sided);
  EXPECT_FALSE(scene.surfaces[0].two_sided);
  ASSERT_EQ(scene.n_polygons(), 4);
  EXPECT_EQ(scene.vertices[scene.polygon(0)[2]], Vec3(2e-3, 3e-3, 0));
  EXPECT_EQ(scene.vertices[scene.polygon(1)[3]], Vec3(0, 1e-3, 1e-3));
  // The mesh is in metres, its translation in the scene's millimetres.
  EXPECT_TRUE(scene.vertices[scene.polygon(2)[2]].isApprox(Vec3(2, 2, 0.5), 1e-15));
  ASSERT_TRUE(scene.camera.has_value());
  EXPECT_EQ(scene.camera->position, Vec3(0, 0, 0.1));
  EXPECT_EQ(scene.camera->direction, Vec3(0, 0, -1));
  EXPECT_EQ(scene.camera->up, Vec3(0, 1, 0));
  EXPECT_DOUBLE_EQ(scene.camera->vertical_fov, kPi / 2);
  EXPECT_EQ(scene.closed, std::optional(false));
  EXPECT_TRUE(scene.warnings.empty());
  const Scene in_metres = io::read_scene(folder() / "a.json", {.unit = "m", .progress = {}});
  EXPECT_EQ(in_metres.camera->position, Vec3(0, 0, 100));
}

// Cameras by name, in the order of the file and in its unit.
TEST_F(SceneJson, ReadsViews) {
  const Scene views = read("a.json", scene(R"("unit": "mm", "views": {
      "door": {"position": [0, 0, 2000], "look_at": [0, 0, 0], "vertical_fov_deg": 90},
      "above": {"position": [0, 500, 0], "direction": [0, -2, 0]}}, )"));
  ASSERT_EQ(views.views.size(), 2U);
  EXPECT_EQ(views.views[0].name, "door");
  EXPECT_EQ(views.views[0].camera.position, Vec3(0, 0, 2));
  EXPECT_EQ(views.views[0].camera.direction, Vec3(0, 0, -1));
  EXPECT_DOUBLE_EQ(views.views[0].camera.vertical_fov, kPi / 2);
  EXPECT_EQ(views.views[1].name, "above");
  EXPECT_EQ(views.views[1].camera.up, Vec3(0, 0, 1));
  EXPECT_FALSE(views.camera.has_value());
}

TEST_F(SceneJson, ReadsMaterials) {
  const std::string grey = R"("bands": "grey", )";
  const Scene thermal = read("a.json", scene(grey, R"("emissivity": 0.8, "temperature": 300)"));
  EXPECT_DOUBLE_EQ(thermal.materials[0].reflectance[0], 1 - 0.8);
  EXPECT_EQ(thermal.materials[0].emission.kind, Emission::Kind::temperature);
  EXPECT_EQ(thermal.materials[0].emission.value, Eigen::VectorXd::Constant(1, 300));
  EXPECT_EQ(thermal.closed, std::nullopt);
  EXPECT_FALSE(thermal.camera.has_value());

  const Scene power = read("b.json", scene("", R"("reflectance": 0, "power": 60)"));
  EXPECT_EQ(power.bands.kind, Bands::Kind::rgb);
  EXPECT_EQ(power.materials[0].emission.kind, Emission::Kind::power);
  EXPECT_EQ(power.materials[0].emission.value, Eigen::Vector3d::Constant(60));
  const Scene exitance = read(
      "c.json", scene("", R"("reflectance": [0, 0.5, 1], "emission": {"exitance": [1, 2, 3]})"));
  EXPECT_EQ(exitance.materials[0].reflectance, Eigen::Vector3d(0, 0.5, 1));
  EXPECT_EQ(exitance.materials[0].emission.kind, Emission::Kind::exitance);
}

TEST_F(SceneJson, ReadsWhatIsOffOrDimmed) {
  (void)file("materials.mtl", kMtl);
  (void)file("room.obj", kObj);
  const std::string polygons = R"(, "material": "grey", "polygons": [[[0, 0, 0], [1, 0, 0], )";
  const auto surface = [&](const std::string& name, const std::string& light) {
    return R"({"name": ")" + name + R"(")" + light + polygons + "[0, 1, " + name + "]]]}";
  };
  const Scene scene =
      read("a.json",
           surfaces(surface("1", "") + "," + surface("2", R"(, "light": "off")") + "," +
                    surface("3", R"(, "light": "on")") + "," + surface("4", R"(, "light": 0.25)") +
                    "," + mesh(R"("mesh": "room.obj", "light": "off")")));
  const std::vector<double> expected = {1, 0, 1, 0.25, 0, 0};
  ASSERT_EQ(scene.surfaces.size(), expected.size());
  for (std::size_t s = 0; s < expected.size(); ++s) {
    EXPECT_EQ(scene.surfaces[s].emission_factor, expected[s]) << s;
  }
  for (const char* light : {R"("dark")", "-1", "true", "[1]"}) {
    const std::string bad = surfaces(surface("1", std::string(R"(, "light": )") + light));
    EXPECT_CONTAINS(error_of("b.json", bad), "surfaces[0].light");
  }
}

TEST_F(SceneJson, PlacesMeshes) {
  (void)file("materials.mtl", kMtl);
  (void)file("room.obj", kObj);
  const Scene whole = read("a.json", surfaces(mesh(R"("mesh": "room.obj")")));
  ASSERT_EQ(whole.surfaces.size(), 2U);
  EXPECT_EQ(whole.surfaces[0].name, "m/square");
  EXPECT_EQ(whole.materials[whole.surfaces[1].material].emission.value, Eigen::Vector3d(3, 2, 1));

  const Scene one = read("b.json", surfaces(mesh(R"("mesh": "room.obj", "object": "lamp",
      "material": "grey", "transform": {"rotate": {"axis": [0, 0, 2], "degrees": 90},
      "scale": [2, 1, 1], "translate": [0, 0, 5]})")));
  ASSERT_EQ(one.surfaces.size(), 1U);
  EXPECT_EQ(one.surfaces[0].name, "m");
  EXPECT_EQ(one.materials[one.surfaces[0].material].name, "grey");
  ASSERT_EQ(one.n_polygons(), 1);
  // (1, 1, 0) is first stretched to (2, 1, 0), then turned, then lifted.
  EXPECT_TRUE(one.vertices[one.polygon(0)[2]].isApprox(Vec3(-1, 2, 5), 1e-15));

  const Scene mirror = read("c.json", surfaces(mesh(R"("mesh": "room.obj", "transform": {"matrix":
      [[-1, 0, 0, 7], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]})")));
  const auto triangle = mirror.polygon(1);
  EXPECT_EQ(mirror.vertices[triangle[0]], Vec3(6, 1, 0));
  EXPECT_EQ(mirror.vertices[triangle[2]], Vec3(7, 0, 0));
}

TEST_F(SceneJson, ReadsCameras) {
  const auto camera = [&](const std::string& members) {
    return *read("a.json", scene(R"("camera": {"position": [0, 0, 0], )" + members + "}, ")).camera;
  };
  const auto film = camera(R"("direction": [0, 0, 3], "focal_length": 35, "film": [36, 24])");
  EXPECT_DOUBLE_EQ(film.vertical_fov, 2 * std::atan(12.0 / 35));
  EXPECT_EQ(film.direction, Vec3(0, 0, 1));
  EXPECT_DOUBLE_EQ(
      camera(R"("look_at": [1, 0, 0], "focal_length": 0.05, "film": 0.1)").vertical_fov, kPi / 2);
  const auto down = camera(R"("direction": [0, -1, 0])");
  EXPECT_GT(down.up.cross(down.direction).norm(), 0.5);
  EXPECT_EQ(camera(R"("direction": [1, 0, 0], "up": [0, 0, 2])").up, Vec3(0, 0, 1));
}

struct BadScene {
  std::string content;
  const char* message;
};

// By its direction, or by angles from north by east and above the horizon.
TEST_F(SceneJson, ReadsSuns) {
  const auto sun = [&](const std::string& members) {
    return *read("a.json", scene(R"("sun": {"irradiance": 1000, )" + members + "}, ")).sun;
  };
  const double low = std::sqrt(0.5);
  EXPECT_EQ(sun(R"("direction": [0, 0, -2])").direction, Vec3(0, 0, -1));
  EXPECT_EQ(sun(R"("direction": [0, 0, -2])").irradiance, Eigen::Vector3d::Constant(1000));
  const auto expect_sun = [&](const std::string& members, const Vec3& towards) {
    EXPECT_TRUE(sun(members).direction.isApprox(-towards, 1e-14)) << members;
  };
  // Where z is up north is +y and east +x; where y is up, -z and +x.
  expect_sun(R"("azimuth_deg": 0, "elevation_deg": 45)", Vec3(0, low, low));
  expect_sun(R"("azimuth_deg": 90, "elevation_deg": 45)", Vec3(low, 0, low));
  expect_sun(R"("azimuth_deg": 180, "elevation_deg": 45, "up": [0, 1, 0])", Vec3(0, low, low));
  expect_sun(R"("azimuth_deg": 90, "elevation_deg": 45, "up": [0, 1, 0])", Vec3(low, low, 0));
  expect_sun(R"("azimuth_deg": 90, "elevation_deg": 45, "north": [1, 0, 1])", Vec3(0, -low, low));
  (void)file("spectra.csv", kCsv);
  const Scene spectral =
      read("a.json", scene(R"("bands": [400, 600], "sun": {"direction": [1, 0, 0],
          "irradiance": {"csv": "spectra.csv", "column": "white"}}, )"));
  EXPECT_EQ(spectral.sun->irradiance.size(), 2);
  EXPECT_TRUE(std::any_of(spectral.files.begin(), spectral.files.end(),
                          [](const auto& path) { return path.filename() == "spectra.csv"; }));
  const Scene night = read("a.json", scene(R"("sun": {"irradiance": 1, "azimuth_deg": 7,
                                              "elevation_deg": -3}, )"));
  ASSERT_EQ(night.warnings.size(), 1U);
  EXPECT_CONTAINS(night.warnings[0], "the sun is not above the horizon (elevation_deg -3)");
}

// How luminaires hang, in the scene's unit: where C0, C90 and the axis point.
TEST_F(SceneJson, ReadsLuminaires) {
  (void)file("a.ies", "IESNA91\nTILT=NONE\n1 -1 1 2 1 1 2 .3 1.2 0\n1 1 9\n0 180\n0\n1 1\n");
  const auto luminaires = [&](const std::string& members) {
    return read("a.json", scene(R"("unit": "mm", "luminaires": [{"name": "l", "file": "a.ies",
        "position": [1000, 2000, 3000])" +
                                members + "}], "))
        .luminaires;
  };
  const auto expect_axes = [&](const std::string& members, const Vec3& c0, const Vec3& c90,
                               const Vec3& axis) {
    const auto read = luminaires(", " + members);
    ASSERT_EQ(read.size(), 1U);
    EXPECT_TRUE(read[0].position.isApprox(Vec3(1, 2, 3), 1e-15));
    EXPECT_TRUE(read[0].axes.col(0).isApprox(c0, 1e-14)) << members;
    EXPECT_TRUE(read[0].axes.col(1).isApprox(c90, 1e-14)) << members;
    EXPECT_TRUE(read[0].axes.col(2).isApprox(-axis, 1e-14)) << members;
  };
  const Vec3 x(1, 0, 0);
  const Vec3 y(0, 1, 0);
  const Vec3 z(0, 0, 1);
  expect_axes(R"("dimming": 1)", x, y, -z);
  expect_axes(R"("turn_deg": 90)", y, -x, -z);
  expect_axes(R"("direction": [0, 0, 2])", x, -y, z);
  expect_axes(R"("aim": [1000, 9000, 3000])", x, z, y);
  expect_axes(R"("aim": [1000, 9000, 3000], "turn_deg": -90)", -z, x, y);
  expect_axes(R"("direction": [0, 1, 0], "c0": [5, 3, 0])", x, z, y);
  expect_axes(R"("up": [0, 1, 0])", x, -z, -y);
  expect_axes(R"("rotations_deg": [90, 0, 0])", x, z, y);
  expect_axes(R"("rotations_deg": [0, 0, 90])", y, -x, -z);
  expect_axes(R"("rotations_deg": [90, 0, 90])", y, z, -x);
  const auto array = luminaires(R"(, "points": [4, 2], "array": {"rows": 2, "columns": 3,
      "row_step": [0, 500, 0], "column_step": [100, 0, 0]})");
  ASSERT_EQ(array.size(), 6U);
  EXPECT_EQ(array[5].name, "l-2-3");
  EXPECT_TRUE(array[5].position.isApprox(Vec3(1.2, 2.5, 3), 1e-15));
  EXPECT_EQ(array[5].divisions, (std::array{4, 2}));
  const Scene both = read("b.json", scene(R"("luminaires": [
      {"name": "a", "file": "a.ies", "position": [0, 0, 1]},
      {"name": "b", "file": "a.ies", "position": [0, 0, 2], "spectrum": [2, 1, 1]}], )"));
  EXPECT_EQ(both.photometries.size(), 1U);
  // One lumen: 179 lm/W of white, and of any colour.
  EXPECT_TRUE(both.luminaires[0].watts_per_lumen.isConstant(1.0 / 179, 1e-15));
  const Eigen::VectorXd& colored = both.luminaires[1].watts_per_lumen;
  EXPECT_NEAR(179 * Vec3(0.2126, 0.7152, 0.0722).dot(colored), 1, 1e-14);
  EXPECT_NEAR(colored[0] / colored[1], 2, 1e-14);
  EXPECT_TRUE(both.warnings.empty());
  // Tilted beyond the table of its file: told once for an array.
  (void)file("t.ies",
             "IESNA91\nTILT=INCLUDE\n1\n2\n0 60\n1 .5\n1 -1 1 2 1 1 2 .3 1.2 0\n1 1 9\n0 180\n0\n1 "
             "1\n");
  const Scene tilted = read("c.json", scene(R"("luminaires": [{"name": "t", "file": "t.ies",
      "position": [0, 0, 1], "direction": [1, 0, 0], "maintenance_factor": 0.5,
      "array": {"columns": 2, "column_step": [1, 0, 0]}}], )"));
  EXPECT_EQ(tilted.luminaires[1].maintenance_factor, 0.5);
  ASSERT_EQ(tilted.warnings.size(), 1U);
  EXPECT_CONTAINS(
      tilted.warnings[0],
      "luminaire \"t\" is tilted by 90 degrees, but the TILT table of its file ends at 60");
}

TEST_F(SceneJson, ReadsBandsOfHeat) {
  const std::string paint =
      R"("solar": {"absorptivity": 0.2}, "infrared": {"emissivity": 0.9}, "temperature": 300)";
  const std::string sun = R"("sun": {"direction": [0, 0, -1], "irradiance": 1361}, )";
  const Scene two = read("a.json", scene(R"("bands": "solar-infrared", )" + sun, paint));
  EXPECT_EQ(two.bands.kind, Bands::Kind::solar_infrared);
  EXPECT_TRUE(two.materials[0].reflectance.isApprox(Eigen::Vector2d(0.8, 0.1), 1e-15));
  EXPECT_EQ(two.sun->irradiance, Eigen::Vector2d(1361, 0));
  const Scene split = read("a.json", scene(R"("bands": {"split_wavelength": 3}, )", paint));
  EXPECT_EQ(split.bands.kind, Bands::Kind::solar_infrared);
  EXPECT_EQ(split.bands.edges, std::vector<double>{3});
  const Scene three = read("a.json", scene(R"("bands": {"thermal": [1, 4.5]}, )" + sun,
                                           R"("emissivity": [0.1, 0.2, 1], "temperature": 9)"));
  EXPECT_EQ(three.bands.kind, Bands::Kind::thermal);
  EXPECT_EQ(three.bands.edges, (std::vector<double>{1, 4.5}));
  EXPECT_TRUE(three.materials[0].reflectance.isApprox(Eigen::Vector3d(0.9, 0.8, 0), 1e-15));
  EXPECT_NEAR(three.sun->irradiance.sum(), 1361, 1e-9);
  // Tables have F = 0.70101 at 5600 µm K and 0.72012 at 5800; linear between them, which is off by
  // less than 2e-4, that is 0.7174 of a black body of 5772 K below 1 µm.
  EXPECT_NEAR(three.sun->irradiance[0] / 1361, 0.7174, 2e-4);
}

TEST_F(SceneJson, ExplainsBadBandsOfHeat) {
  const std::string paint = R"("solar": {"absorptivity": 0.2}, "infrared": {"emissivity": 0.9})";
  const std::string two = R"("bands": "solar-infrared", )";
  const std::vector<BadScene> bad = {
      {scene(R"("bands": {}, )"), "bands: expected either \"thermal\" or \"split_wavelength\""},
      {scene(R"("bands": {"thermal": []}, )"), "bands.thermal: has no wavelengths"},
      {scene(R"("bands": {"thermal": [8, 4]}, )"), "wavelength 4 does not follow 8"},
      {scene(R"("bands": {"split_wavelength": 0}, )"), "wavelength 0 is not positive"},
      {scene(R"("bands": "solar", )"), "bands: found \"solar\", expected"},
      {scene(R"("bands": "grey", )", paint), "need \"bands\": \"solar-infrared\""},
      {scene(two, R"("solar": {"absorptivity": 0.2})"), "materials.grey: has no \"infrared\""},
      {scene(two, paint + R"(, "reflectance": 0.5)"), "expected either \"solar\" and"},
      {scene(two, R"("solar": {"absorptivity": 2}, "infrared": {"emissivity": 1})"),
       "materials.grey.solar.absorptivity: absorptivity 2 is outside [0, 1]"},
      {scene(two, R"("solar": {"emissivity": 1}, "infrared": {"emissivity": 1})"),
       "materials.grey.solar"},
      {scene(two, R"("emissivity": [0.5, -1])"), "emissivity -1 is outside [0, 1]"},
      {scene(two, R"("emissivity": [0.5, 1, 1])"), "found 3 values, expected 2, one per band"},
  };
  for (const auto& [content, message] : bad) EXPECT_CONTAINS(error_of("a.json", content), message);
}

TEST_F(SceneJson, ExplainsBadSuns) {
  const auto with_sun = [](const std::string& members) {
    return scene(R"("sun": {)" + members + "}, ");
  };
  const std::vector<BadScene> bad = {
      {with_sun(R"("direction": [0, 0, -1])"), "sun: has no \"irradiance\""},
      {with_sun(R"("irradiance": 1)"), "sun: expected either \"direction\" or \"azimuth_deg\""},
      {with_sun(R"("irradiance": 1, "direction": [0, 0, 0])"), "sun.direction: "},
      {with_sun(R"("irradiance": -1, "direction": [0, 0, 1])"),
       "sun.irradiance: irradiance is -1, expected a finite"},
      {with_sun(R"("irradiance": [1, 2], "direction": [0, 0, 1])"),
       "sun.irradiance: found 2 values, expected 3, one per band"},
      {with_sun(R"("irradiance": 1, "direction": [0, 0, 1], "azimuth_deg": 3)"),
       "sun: expected either"},
      {with_sun(R"("irradiance": 1, "direction": [0, 0, 1], "up": [0, 0, 1])"),
       "sun.up: goes with \"azimuth_deg\" and \"elevation_deg\" only"},
      {with_sun(R"("irradiance": 1, "azimuth_deg": 3)"), "sun: has no \"elevation_deg\""},
      {with_sun(R"("irradiance": 1, "azimuth_deg": 3, "elevation_deg": 95)"),
       "sun.elevation_deg: 95 is outside [-90, 90]"},
      {with_sun(R"("irradiance": 1, "azimuth_deg": 3, "elevation_deg": 9, "north": [0, 0, 2])"),
       "sun.north: is parallel to \"up\""},
      {with_sun(R"("irradiation": 1)"), "sun: "},
  };
  for (const auto& [content, message] : bad) EXPECT_CONTAINS(error_of("a.json", content), message);
}

TEST_F(SceneJson, ExplainsBadStructure) {
  const std::string triangle = R"("polygons": [[[0, 0, 0], [2, 0, 0], [2, 3, 0]]])";
  const std::vector<BadScene> bad = {
      {surfaces(R"({"name": "a", "material": "grey", )" + triangle + R"(},
                   {"name": "b", "materail": "grey"})"),
       R"(a.json: surfaces[1]: unknown key "materail", did you mean "material"?)"},
      {scene(R"("kamera": {}, )"), R"(a.json: unknown key "kamera", did you mean "camera"?)"},
      {scene(R"("zzzzzzzzzz": 1, )"), "known are $schema, name"},
      {scene("", R"("reflectence": 1)"), R"(materials.grey: unknown key "reflectence")"},
      {"{\n\"unit\": \"m\",\n}", "a.json:3: syntax error"},
      {"[]", "a.json: expected an object, found a list of 0"},
      {"{}", "a.json: has no \"surfaces\""},
      {surfaces(""), "a.json: has no polygons"},
      {scene(R"("unit": "m", "unit": "mm", )"), "key \"unit\" stands twice"},
      {scene(R"("unit": "yard", )"), "a.json: unit: unknown unit \"yard\", expected one of m, mm"},
      {scene(R"("unit": 1, )"), "a.json: unit: expected a string, found 1"},
      {scene(
           R"("symmetry": {"mirror": ["x=0"]}, "sun": {"direction": [0, 0, -1], "irradiance": 1}, )"),
       "a.json: has both a sun and a symmetry"},
      {scene(R"("symmetry": {}, )"), "symmetry: expected \"mirror\", \"rotation\" or"},
      {scene(R"("symmetry": {"mirror": ["w=0"]}, )"),
       "a.json: symmetry.mirror[0]: found \"w=0\", expected a plane such as \"x=0\""},
      {scene(R"("symmetry": {"mirror": ["x=0", "x=1"]}, )"), "symmetry: mirror planes or axes"},
      {scene(R"("symmetry": {"mirror": [{"point": [0, 0, 0], "normal": [0, 0, 0]}]}, )"),
       "symmetry.mirror[0].normal: "},
      {scene(R"("symmetry": {"rotation": {"axis": [0, 0, 1], "folds": 2.5}}, )"),
       "symmetry.rotation.folds: is 2.5, expected a whole number from 2 to 4096"},
      {scene(R"("symmetry": {"translation": [[1, 0, 0]]}, )"),
       "symmetry: expected either \"cut_off\" or \"images\""},
      {scene(R"("symmetry": {"translation": [[0, 0, 0]], "images": 1}, )"),
       "symmetry.translation[0]: is 0"},
      {scene(R"("symmetry": {"translation": [[1, 0, 0]], "cut_off": -1}, )"),
       "symmetry.cut_off: is -1"},
      {scene(R"("symmetry": {"mirror": ["x=0"], "images": 3}, )"), "a cut-off without a"},
      {scene(R"("closed": "yes", )"), "closed: expected true or false, found \"yes\""},
      {scene(R"("bands": "gray", )"), "bands: found \"gray\", expected \"rgb\", \"grey\""},
      {scene(R"("bands": [500, 400], )"), "bands[1]: wavelength 400 does not follow 500"},
      {scene(R"("bands": [0], )"), "bands[0]: wavelength 0 is not positive"},
      {scene(R"("bands": [], )"), "bands: has no wavelengths"},
      {scene(R"("camera": {"position": [0, 0, 0]}, )"), "camera: expected either \"look_at\""},
      {scene(R"("camera": {"direction": [0, 0, 1]}, )"), "camera: has no \"position\""},
      {scene(R"("views": [], )"), "views: expected an object of cameras by name"},
      {scene(R"("views": {"": {}}, )"), "views: has a view without a name"},
      {scene(R"("views": {"door": {"direction": [0, 0, 1]}}, )"),
       "views.door: has no \"position\""},
      {scene(R"("camera": {"position": [0, 0], "direction": [0, 0, 1]}, )"),
       "camera.position: expected three numbers [x, y, z], found a list of 2"},
      {scene(R"("camera": {"position": [0, 0, 0], "direction": [0, 0, 0]}, )"),
       "camera.direction: is [0, 0, 0], expected a direction"},
      {scene(R"("camera": {"position": [0, 0, 0], "direction": [0, 2, 0], "up": [0, 1, 0]}, )"),
       "camera.up: is parallel to the viewing direction"},
      {scene(R"("camera": {"position": [0, 0, 0], "look_at": [0, 0, 0]}, )"),
       "camera.look_at: is the camera's position"},
      {scene(R"("camera": {"position": [0, 0, 0], "direction": [0, 2, 0],
                "vertical_fov_deg": 180}, )"),
       "camera.vertical_fov_deg: 180 is outside (0, 180)"},
      {scene(R"("camera": {"position": [0, 0, 0], "direction": [0, 2, 0], "film": 1}, )"),
       "camera: has no \"focal_length\""},
      {surfaces(R"({"name": "a", )" + triangle + "}"), "surfaces[0]: has no \"material\""},
      {surfaces(R"({"material": "grey", )" + triangle + "}"), "surfaces[0]: has no \"name\""},
      {surfaces(R"({"name": "a", "material": "gray", )" + triangle + "}"),
       "surfaces[0].material: unknown material \"gray\", expected one of grey"},
      {surfaces(R"({"name": "a", "material": "grey", )" + triangle + R"(},
                   {"name": "a", "material": "grey", )" +
                triangle + "}"),
       "surfaces[1]: a surface named \"a\" exists already"},
      {surfaces(R"({"name": "a", "material": "grey"})"),
       "expected either \"mesh\" or \"polygons\""},
      {surfaces(R"({"name": "a", "material": "grey", "polygons": [[[0, 0, 0], [1, 0, 0]]]})"),
       "surfaces[0].polygons[0]: face has 2 vertices"},
      {surfaces(R"({"name": "a", "material": "grey", "polygons": [[0, 1, 2]]})"),
       "surfaces[0].polygons[0][0]: expected a point [x, y, z]; indices need \"vertices\""},
      {surfaces(R"({"name": "a", "material": "grey", "vertices": [[0, 0, 0], [1, 0, 0], [1, 1, 0]],
                    "polygons": [[0, 1, 3]]})"),
       "surfaces[0].polygons[0]: face uses vertex 3, but there are 3"},
      {surfaces(R"({"name": "a", "material": "grey", "polygons": []})"), "has no polygons"},
      {surfaces(
           R"({"name": "a", "material": "grey", "polygons": [[[1e300, 0, 0], [1, 0, 0], [0, 1e999, 0]]]})"),
       "a.json: "},
  };
  for (const auto& [content, message] : bad) EXPECT_CONTAINS(error_of("a.json", content), message);
}

TEST_F(SceneJson, ExplainsBadMaterials) {
  (void)file("spectra.csv", kCsv);
  (void)file("jumbled.csv", "wavelength_nm,white\n500,1\n400,1\n");
  (void)file("bright.csv", "wavelength_nm,white\n400,0.5\n500,1.25\n700,0.5\n");
  (void)file("negative.csv", "wavelength_nm,white\n400,0.5\n500,-0.25\n700,0.5\n");
  const std::string wavelengths = R"("bands": [450, 650], )";
  const std::string csv = R"("reflectance": {"csv": "spectra.csv", "column": )";
  const std::vector<BadScene> bad = {
      {scene("", R"("reflectance": 1.5)"),
       "materials.grey.reflectance: reflectance 1.5 is outside [0, 1]"},
      {scene("", R"("reflectance": [0.5, -0.1, 0])"), "reflectance -0.1 is outside [0, 1]"},
      {scene("", R"("reflectance": [0.5, 0.1])"), "found 2 values, expected 3, one per band"},
      {scene("", R"("emissivity": 2)"), "materials.grey.emissivity: emissivity 2 is outside"},
      {scene("", ""), "materials.grey: expected either \"reflectance\" or \"emissivity\""},
      {scene("", R"("reflectance": 0, "radiance": -1)"), "radiance is -1, expected a finite"},
      {scene(R"("bands": "grey", )", R"("reflectance": 0, "temperature": -1)"),
       "materials.grey.temperature: temperature is -1"},
      {scene("", R"("reflectance": 0, "temperature": 300)"), "a temperature needs \"bands\""},
      {scene("", R"("reflectance": 0, "power": 1, "emission": {"radiance": 1})"),
       "emission is given twice, by \"radiance\" and by \"power\""},
      {scene("", R"("reflectance": 0, "emission": {})"), "emission: expected one of radiance"},
      {scene(wavelengths, csv + R"("white"})"), "spectra.csv covers 400 to 600 nm"},
      {scene(wavelengths, csv + R"("blue"})"),
       "spectra.csv:2: no column \"blue\", expected one of white, red"},
      {scene("", csv + R"("white"})"), "a spectrum needs \"bands\" given as wavelengths"},
      {scene(wavelengths, R"("reflectance": {"csv": "jumbled.csv", "column": "white"})"),
       "jumbled.csv:3: wavelengths do not increase"},
      {scene(wavelengths, R"("reflectance": {"csv": "bright.csv", "column": "white"})"),
       "bright.csv:3: reflectance 1.25 is outside [0, 1]"},
      {scene(wavelengths, R"("reflectance": {"csv": "negative.csv", "column": "white"})"),
       "negative.csv:3: reflectance -0.25 is outside [0, 1]"},
      {scene(wavelengths,
             R"("reflectance": 0, "radiance": {"csv": "negative.csv", "column": "white"})"),
       "negative.csv:3: radiance is -0.25, expected a finite"},
      {scene(R"("bands": [300, 350], )", csv + R"("white"})"), "spectra.csv covers 400 to 600 nm"},
      {scene(wavelengths, R"("reflectance": {"csv": "gone.csv", "column": "white"})"),
       "gone.csv: no such file"},
  };
  for (const auto& [content, message] : bad) EXPECT_CONTAINS(error_of("a.json", content), message);
}

TEST_F(SceneJson, ExplainsBadMeshes) {
  (void)file("materials.mtl", kMtl);
  (void)file("room.obj", kObj);
  (void)file("square.off", kOff);
  const std::vector<BadScene> bad = {
      {surfaces(mesh(R"("mesh": "gone.obj")")), "gone.obj: no such file"},
      {surfaces(mesh(R"("mesh": "square.off")")),
       "surfaces[0]: has no \"material\", and square.off gives none to its surface \"square\""},
      {surfaces(mesh(R"("mesh": "room.obj", "object": "door")")),
       "surfaces[0].object: no surface \"door\" in the mesh, expected one of square, lamp"},
      {R"({"bands": "grey", "surfaces": [)" + mesh(R"("mesh": "room.obj")") + "]}",
       "the materials of room.obj have 3 bands (RGB), the scene has 1 (grey)"},
      {surfaces(mesh(R"("mesh": "a.json")")), "surfaces[0].mesh: is a scene, expected a mesh file"},
      {surfaces(mesh(R"("mesh": "room.obj", "polygons": [])")),
       "has both \"mesh\" and \"polygons\""},
      {surfaces(mesh(R"("mesh": "room.obj", "transform": {"scale": 0})")),
       "surfaces[0].transform: the transform flattens space"},
      {surfaces(mesh(R"("mesh": "room.obj", "transform": {"scale": 2, "matrix": [[1]]})")),
       "surfaces[0].transform: expected \"matrix\" alone"},
      {surfaces(mesh(R"("mesh": "room.obj", "transform": {"matrix": [[1]]})")),
       "surfaces[0].transform.matrix: expected 4 rows"},
      {surfaces(mesh(R"("mesh": "room.obj", "transform": {"rotate": {"axis": [0, 0, 1]}})")),
       "surfaces[0].transform.rotate: has no \"degrees\""},
  };
  for (const auto& [content, message] : bad) EXPECT_CONTAINS(error_of("a.json", content), message);
}

/// The schema, for editors, and the reader know the same keys.
TEST(SceneSchema, ListsTheKeysOfTheReader) {
  std::ifstream stream(std::filesystem::path(RADIOSITY_SCENES) / "../docs/scene.schema.json");
  const auto definitions = nlohmann::json::parse(stream).at("$defs");
  const auto expect_keys = [&](const char* name, std::span<const std::string_view> keys) {
    std::set<std::string> listed;
    for (const auto& [key, unused] : definitions.at(name).at("properties").items()) {
      listed.insert(key);
    }
    EXPECT_EQ(listed, std::set<std::string>(keys.begin(), keys.end())) << name;
    EXPECT_EQ(definitions.at(name).at("additionalProperties"), false) << name;
  };
  expect_keys("scene", io::keys::kScene);
  expect_keys("material", io::keys::kMaterial);
  expect_keys("emission", io::keys::kEmission);
  expect_keys("spectrum", io::keys::kSpectrum);
  expect_keys("surface", io::keys::kSurface);
  expect_keys("transform", io::keys::kTransform);
  expect_keys("rotation", io::keys::kRotation);
  expect_keys("camera", io::keys::kCamera);
  expect_keys("sun", io::keys::kSun);
  expect_keys("luminaire", io::keys::kLuminaire);
  expect_keys("luminaire_array", io::keys::kLuminaireArray);
  expect_keys("sky", io::keys::kSky);
  expect_keys("perez", io::keys::kPerez);
  expect_keys("weather", io::keys::kWeather);
  expect_keys("distribution", io::keys::kDistribution);
  expect_keys("glazing", io::keys::kGlazing);
  expect_keys("bands", io::keys::kBands);
  expect_keys("solar", io::keys::kSolar);
  expect_keys("infrared", io::keys::kInfrared);
  expect_keys("symmetry", io::keys::kSymmetry);
  expect_keys("mirror", io::keys::kMirror);
  expect_keys("symmetry_rotation", io::keys::kSymmetryRotation);
  expect_keys("grid", io::keys::kGrid);
  expect_keys("required", io::keys::kRequired);
  expect_keys("observer", io::keys::kObserver);
  for (const auto& unit : definitions.at("unit").at("enum")) {
    EXPECT_GT(io::metres_per_unit(unit.get<std::string>()), 0);
  }
}

/// Vector area of polygon i, m².
Vec3 polygon_area(const Scene& scene, radiosity::Index i) {
  std::vector<Vec3> points;
  for (const auto index : scene.polygon(i)) points.push_back(scene.vertices[index]);
  return radiosity::vector_area(points);
}

TEST(Scenes, AllLoad) {
  int n_scenes = 0;
  for (const auto& entry : std::filesystem::directory_iterator(RADIOSITY_SCENES)) {
    if (entry.path().extension() != ".json") continue;
    SCOPED_TRACE(entry.path().string());
    const Scene scene = io::read_scene(entry.path());
    EXPECT_TRUE(scene.warnings.empty());
    // The vector areas of a closed surface add up to zero; coordinates are rounded to 1e-9 m.
    double total = 0;
    Vec3 sum = Vec3::Zero();
    for (radiosity::Index i = 0; i < scene.n_polygons(); ++i) {
      // The two sides of a two-sided one do so by themselves.
      if (!scene.surfaces[scene.polygon_surface[i]].two_sided) sum += polygon_area(scene, i);
      total += polygon_area(scene, i).norm();
    }
    if (scene.closed == true) {
      EXPECT_LT(sum.norm(), 1e-9 * total);
    }
    ++n_scenes;
  }
  EXPECT_GE(n_scenes, 10);
}

TEST(Scenes, CornellBoxFacesInwards) {
  const auto data = std::filesystem::path(RADIOSITY_TEST_DATA);
  const Scene scene = io::read_scene(std::filesystem::path(RADIOSITY_SCENES) / "cornell-box.json");
  const Scene reference =
      io::read_scene(data / "cornell-box/patches-8x8.obj", {.unit = "mm", .progress = {}});
  const auto surface_area = [](const Scene& whole, const std::string& name) {
    Vec3 sum = Vec3::Zero();
    for (radiosity::Index i = 0; i < whole.n_polygons(); ++i) {
      if (whole.surfaces[whole.polygon_surface[i]].name == name) sum += polygon_area(whole, i);
    }
    return sum;
  };
  ASSERT_EQ(scene.surfaces.size(), 16U);
  for (const auto& surface : scene.surfaces) {
    Vec3 expected = surface_area(reference, surface.name);
    if (surface.name == "floor") {  // which leaves out the blocks' feet; they are like their tops
      expected -= surface_area(reference, "short_top") + surface_area(reference, "tall_top");
    }
    EXPECT_GT(expected.norm(), 0) << surface.name;
    // The reference has 12 digits or so; its bilinear patches add up to the same vector area.
    EXPECT_LT((surface_area(scene, surface.name) - expected).norm(), 1e-9) << surface.name;
  }
  EXPECT_NEAR(scene.camera->vertical_fov * 180 / kPi, 39.3076, 5e-5);
}

TEST(Scenes, SpectralCornellBoxIsTheSameBoxInMeasuredBands) {
  const std::filesystem::path folder(RADIOSITY_SCENES);
  const Scene rgb = io::read_scene(folder / "cornell-box.json");
  const Scene scene = io::read_scene(folder / "cornell-box-spectral.json");
  EXPECT_EQ(scene.vertices, rgb.vertices);
  EXPECT_EQ(scene.corners, rgb.corners);
  EXPECT_EQ(scene.first_corner, rgb.first_corner);
  EXPECT_EQ(scene.polygon_surface, rgb.polygon_surface);
  EXPECT_EQ(scene.camera->position, rgb.camera->position);
  ASSERT_EQ(scene.bands.count(), 76);
  EXPECT_EQ(scene.bands.wavelengths.front(), 400);
  EXPECT_EQ(scene.bands.wavelengths.back(), 700);
  for (std::size_t s = 0; s < scene.surfaces.size(); ++s) {
    EXPECT_EQ(scene.surfaces[s].name, rgb.surfaces[s].name);
    EXPECT_EQ(scene.materials[scene.surfaces[s].material].name,
              rgb.materials[rgb.surfaces[s].material].name);
  }
  EXPECT_EQ(scene.materials[0].reflectance[0], 0.343);  // white at 400 nm
  EXPECT_EQ(scene.materials[1].reflectance[5], 0.050);  // red at 420 nm
  EXPECT_EQ(scene.materials[2].reflectance[1], 0.096);  // green at 404 nm
  EXPECT_EQ(scene.materials[3].reflectance, Eigen::VectorXd::Constant(76, 0.78));
  // Light: 0 at 400 nm, 8 at 500 nm, 18.4 at 700 nm.
  EXPECT_EQ(scene.materials[3].emission.kind, Emission::Kind::radiance);
  EXPECT_NEAR(scene.materials[3].emission.value[10], 3.2, 1e-12);
  EXPECT_EQ(scene.materials[3].emission.value[75], 18.4);
}

}  // namespace
