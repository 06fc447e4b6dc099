#include "io/scene/scene_writer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numeric>
#include <random>
#include <vector>

#include "io/light/photometric_file.h"
#include "radiosity/base/error.h"
#include "tests/support/damaged_files.h"
#include "tests/support/output_folder.h"
#include "tests/support/scratch_files.h"

namespace {

using namespace radiosity;

bool is_same(double a, double b) { return a == b && std::signbit(a) == std::signbit(b); }

void expect_same(const Vec3& a, const Vec3& b) {
  for (int k = 0; k < 3; ++k) EXPECT_TRUE(is_same(a[k], b[k])) << a[k] << " is not " << b[k];
}

/// All but the polygons.
void expect_same_frame(const Scene& read, const Scene& scene) {
  EXPECT_EQ(read.name, scene.name);
  EXPECT_EQ(read.description, scene.description);
  EXPECT_EQ(read.bands.kind, scene.bands.kind);
  EXPECT_EQ(read.bands.wavelengths, scene.bands.wavelengths);
  EXPECT_EQ(read.bands.edges, scene.bands.edges);
  EXPECT_EQ(read.closed, scene.closed);
  EXPECT_EQ(read.precision, scene.precision);
  ASSERT_EQ(read.materials.size(), scene.materials.size());
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    EXPECT_EQ(read.materials[i].name, scene.materials[i].name);
    EXPECT_EQ(read.materials[i].reflectance, scene.materials[i].reflectance);
    EXPECT_EQ(read.materials[i].emission.kind, scene.materials[i].emission.kind);
    EXPECT_EQ(read.materials[i].emission.value, scene.materials[i].emission.value);
  }
  ASSERT_EQ(read.views.size(), scene.views.size());
  for (std::size_t k = 0; k < scene.views.size(); ++k) {
    EXPECT_EQ(read.views[k].name, scene.views[k].name);
    EXPECT_EQ(read.views[k].camera.position, scene.views[k].camera.position);
    EXPECT_EQ(read.views[k].camera.vertical_fov, scene.views[k].camera.vertical_fov);
  }
  ASSERT_EQ(read.sun.has_value(), scene.sun.has_value());
  if (scene.sun) {
    expect_same(read.sun->direction, scene.sun->direction);
    EXPECT_EQ(read.sun->irradiance, scene.sun->irradiance);
  }
  ASSERT_EQ(read.camera.has_value(), scene.camera.has_value());
  if (!scene.camera) return;
  expect_same(read.camera->position, scene.camera->position);
  expect_same(read.camera->direction, scene.camera->direction);
  expect_same(read.camera->up, scene.camera->up);
  EXPECT_EQ(read.camera->vertical_fov, scene.camera->vertical_fov);
}

void expect_same_surfaces(const Scene& read, const Scene& scene) {
  ASSERT_EQ(read.surfaces.size(), scene.surfaces.size());
  for (std::size_t i = 0; i < scene.surfaces.size(); ++i) {
    EXPECT_EQ(read.surfaces[i].name, scene.surfaces[i].name);
    EXPECT_EQ(read.surfaces[i].material, scene.surfaces[i].material);
    EXPECT_EQ(read.surfaces[i].two_sided, scene.surfaces[i].two_sided);
    EXPECT_EQ(read.surfaces[i].emission_factor, scene.surfaces[i].emission_factor);
  }
}

void expect_same_polygons(const Scene& read, const Scene& scene) {
  EXPECT_EQ(read.polygon_surface, scene.polygon_surface);
  ASSERT_EQ(read.first_corner, scene.first_corner);
  for (std::size_t k = 0; k < scene.corners.size(); ++k) {
    expect_same(read.vertices[read.corners[k]], scene.vertices[scene.corners[k]]);
  }
}

/// The polygons surface by surface, as the format has them; of one surface in the order they have.
Scene sorted_by_surface(const Scene& scene) {
  std::vector<Index> order(static_cast<std::size_t>(scene.n_polygons()));
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) {
    return scene.polygon_surface[a] < scene.polygon_surface[b];
  });
  Scene sorted = scene;
  sorted.corners.clear();
  sorted.first_corner = {0};
  sorted.polygon_surface.clear();
  for (const Index i : order) sorted.add_polygon(scene.polygon(i), scene.polygon_surface[i]);
  return sorted;
}

class SceneWriter : public OutputFolder {
 protected:
  [[nodiscard]] Scene written_and_read(const Scene& scene) const {
    const auto path = folder() / "scene.json";
    io::write_scene(path, scene);
    Scene read = io::read_scene(path);
    EXPECT_TRUE(read.warnings.empty());
    // Once more, and nothing changes.
    io::write_scene(folder() / "again.json", read);
    EXPECT_EQ(test::file_bytes(folder() / "again.json"), test::file_bytes(path));
    return read;
  }
};

/// A grey scene of one triangle.
Scene make_scene() {
  Scene scene;
  scene.bands.kind = Bands::Kind::grey;
  scene.materials = {{"grey", Eigen::VectorXd::Constant(1, 0.1 + 0.2), {}}};
  scene.surfaces = {{"floor", 0, false}};
  scene.vertices = {{-0.0, 1. / 3, 1e-300}, {1e22, 5e-324, 1}, {0.1, 1e16, -123456789.123456789}};
  scene.add_polygon(std::vector<std::int32_t>{0, 1, 2}, 0);
  return scene;
}

TEST_F(SceneWriter, GivesBackAllScenesThatComeWithTheProgram) {
  int n_scenes = 0;
  for (const auto& entry : std::filesystem::directory_iterator(RADIOSITY_SCENES)) {
    const auto extension = entry.path().extension();
    if (extension != ".json" && extension != ".obj") continue;
    SCOPED_TRACE(entry.path().string());
    const Scene scene = io::read_scene(entry.path());
    const Scene read = written_and_read(scene);
    expect_same_frame(read, scene);
    expect_same_surfaces(read, scene);
    expect_same_polygons(read, sorted_by_surface(scene));
    if (entry.path().stem() != "furnished-room") {  // whose surfaces share vertices and take turns
      EXPECT_EQ(read.vertices, scene.vertices);
      EXPECT_EQ(read.corners, scene.corners);
    }
    ++n_scenes;
  }
  EXPECT_GE(n_scenes, 11);
}

TEST_F(SceneWriter, KeepsAllDigits) {
  const Scene scene = make_scene();
  const Scene read = written_and_read(scene);
  expect_same_frame(read, scene);
  expect_same_surfaces(read, scene);
  expect_same_polygons(read, scene);
}

TEST_F(SceneWriter, KeepsEmissionOfEveryKind) {
  for (const auto kind : {Emission::Kind::radiance, Emission::Kind::exitance, Emission::Kind::power,
                          Emission::Kind::temperature}) {
    Scene scene = make_scene();
    scene.materials[0].emission = {kind, Eigen::VectorXd::Constant(1, 1000. / 3)};
    expect_same_frame(written_and_read(scene), scene);
  }
  Scene scene = make_scene();
  scene.bands = {Bands::Kind::wavelengths, {400, 500. + 1. / 3, 1e4}};
  scene.materials[0].reflectance = Eigen::Vector3d(0, 1. / 3, 1);
  scene.materials[0].emission = {Emission::Kind::radiance, Eigen::Vector3d(0, 1e-300, 1e300)};
  expect_same_frame(written_and_read(scene), scene);
}

TEST_F(SceneWriter, KeepsHeats) {
  for (const auto kind : {Emission::Kind::heat_flux, Emission::Kind::heat_power}) {
    Scene scene = make_scene();
    scene.bands.kind = Bands::Kind::grey;
    for (auto& material : scene.materials) material.reflectance = Eigen::VectorXd::Constant(1, 0.3);
    scene.materials[0].emission = {kind, Eigen::VectorXd::Constant(1, -1000. / 3)};
    scene.surfaces[0].two_sided = true;
    scene.surfaces[0].is_shield = true;
    scene.surfaces[0].material = 0;
    scene.surfaces[0].back_material = 0;
    scene.environment = {Emission::Kind::temperature, Eigen::VectorXd::Constant(1, 2.7)};
    const Scene read = written_and_read(scene);
    expect_same_frame(read, scene);
    expect_same_surfaces(read, scene);
    EXPECT_EQ(read.surfaces[0].back_material, 0);
    EXPECT_TRUE(read.surfaces[0].is_shield);
    EXPECT_EQ(read.environment.kind, Emission::Kind::temperature);
    EXPECT_EQ(read.environment.value, scene.environment.value);
  }
}

TEST_F(SceneWriter, KeepsBandsOfHeat) {
  Scene scene = make_scene();
  scene.materials.resize(1);
  for (auto& surface : scene.surfaces) surface.material = 0;
  scene.materials[0].emission = {Emission::Kind::temperature, Eigen::VectorXd::Constant(1, 300)};
  for (const Bands& bands :
       {Bands{.kind = Bands::Kind::solar_infrared, .wavelengths = {}},
        Bands{.kind = Bands::Kind::solar_infrared, .wavelengths = {}, .edges = {3}},
        Bands{.kind = Bands::Kind::thermal, .wavelengths = {}, .edges = {1. / 3, 8}}}) {
    scene.bands = bands;
    scene.materials[0].reflectance = Eigen::VectorXd::LinSpaced(bands.count(), 0.1, 0.8);
    expect_same_frame(written_and_read(scene), scene);
  }
}

TEST_F(SceneWriter, KeepsTheSun) {
  Scene scene = make_scene();
  const Index n = scene.bands.count();
  scene.sun = Sun{.direction = Vec3(0, 0.6, -0.8),
                  .irradiance = Eigen::VectorXd::LinSpaced(n, 1. / 3, 1361)};
  expect_same_frame(written_and_read(scene), scene);
}

TEST_F(SceneWriter, KeepsLuminaires) {
  test::write_bytes(folder() / "lamp.ies",
                    "IESNA91\nTILT=NONE\n1 -1 1 2 1 1 2 0 0 0\n1 1 10\n0 180\n0\n100 30\n");
  Scene scene = make_scene();
  scene.photometries.push_back(io::read_photometric_file(folder() / "lamp.ies"));
  const Eigen::Matrix3d turned = aimed_axes(Vec3(0.6, 0, -0.8), 0.3, Vec3::UnitZ(), Vec3::UnitX());
  for (const double factor : {1., 0., 1. / 3}) {
    Luminaire luminaire;
    luminaire.name = "lamp " + std::to_string(scene.luminaires.size());
    luminaire.position = Vec3(1. / 3, factor, -2);
    luminaire.axes = turned;
    luminaire.dimming = factor;
    luminaire.lumens = factor;
    luminaire.maintenance_factor = factor > 0 ? factor : 0.7;
    luminaire.up = factor == 1 ? Vec3::UnitZ() : Vec3::UnitY();
    luminaire.watts_per_lumen = Eigen::VectorXd::LinSpaced(scene.bands.count(), 0.1, factor);
    scene.luminaires.push_back(luminaire);
  }
  const Scene read = written_and_read(scene);
  ASSERT_EQ(read.luminaires.size(), scene.luminaires.size());
  ASSERT_EQ(read.photometries.size(), 1U);
  EXPECT_EQ(read.photometries[0].web.intensity, scene.photometries[0].web.intensity);
  for (std::size_t k = 0; k < scene.luminaires.size(); ++k) {
    EXPECT_EQ(read.luminaires[k].name, scene.luminaires[k].name);
    expect_same(read.luminaires[k].position, scene.luminaires[k].position);
    EXPECT_TRUE(read.luminaires[k].axes.isApprox(scene.luminaires[k].axes, 1e-15));
    EXPECT_EQ(read.luminaires[k].dimming, scene.luminaires[k].dimming);
    EXPECT_EQ(read.luminaires[k].lumens, scene.luminaires[k].lumens);
    EXPECT_EQ(read.luminaires[k].maintenance_factor, scene.luminaires[k].maintenance_factor);
    EXPECT_EQ(read.luminaires[k].up, scene.luminaires[k].up);
    EXPECT_EQ(read.luminaires[k].watts_per_lumen, scene.luminaires[k].watts_per_lumen);
  }
}

TEST_F(SceneWriter, KeepsWhatIsOffOrDimmedAndWhatTheSceneIsCalled) {
  for (const double factor : {0., 1., 1. / 3, 2.}) {
    Scene scene = make_scene();
    scene.name = "A \"room\"";
    scene.description = "Line 1\nline 2";
    scene.materials[0].emission = {Emission::Kind::power, Eigen::VectorXd::Constant(1, 40)};
    scene.surfaces[0].emission_factor = factor;
    const Scene read = written_and_read(scene);
    expect_same_frame(read, scene);
    expect_same_surfaces(read, scene);
  }
}

/// To the last bit, but for some angles between 52 and 57 degrees, which no number in the file
/// gives.
TEST_F(SceneWriter, KeepsCameras) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> angle(1e-3, kPi - 1e-3);
  for (int i = 0; i < 500; ++i) {
    Scene scene = make_scene();
    const auto vector = [&] { return Vec3(normal(random), normal(random), normal(random)); };
    scene.camera = Camera{vector(), vector().normalized(), vector().normalized(), angle(random)};
    scene.closed = i % 2 == 0;
    const Camera view{vector(), vector().normalized(), vector().normalized(), 1};
    scene.views = {{"from the door", view}, {"", view}, {"from the door", view}};
    const Scene read = written_and_read(scene);
    const double fov = scene.camera->vertical_fov;
    EXPECT_NEAR(read.camera->vertical_fov, fov, 4e-16 * fov);
    if (fov > 52 * kPi / 180 && fov < 58 * kPi / 180) {
      scene.camera->vertical_fov = read.camera->vertical_fov;
    }
    scene.views[1].name = "view";
    scene.views[2].name = "from the door-2";
    expect_same_frame(read, scene);
  }
}

TEST_F(SceneWriter, MakesNamesThatCanBeToldApart) {
  Scene scene = make_scene();
  const Material material = scene.materials[0];
  scene.vertices = {{0, 0, 0}, {1, 0, 0}};
  scene.materials.clear();
  scene.surfaces.clear();
  scene.polygon_surface = {};
  scene.first_corner = {0};
  scene.corners = {};
  const std::vector<std::string> names = {"",  "a",    "a",   "a-2", "", "\"quo\\te\"\n",
                                          "ü", "\xFC", "\xFE"};
  for (std::size_t i = 0; i < names.size(); ++i) {
    scene.materials.push_back(material);
    scene.materials.back().name = names[i];
    scene.surfaces.push_back({names[i], static_cast<int>(names.size() - 1 - i), i % 2 == 1});
    // Polygons that are all the same would be left out.
    const auto corner = static_cast<std::int32_t>(scene.vertices.size());
    scene.vertices.emplace_back(static_cast<double>(i), 3, 7);
    scene.add_polygon(std::vector<std::int32_t>{0, 1, corner}, static_cast<std::int32_t>(i));
  }
  const Scene read = written_and_read(scene);
  const std::vector<std::string> expected = {
      "material",      "a", "a-2",          "a-2-2",         "material-2",
      "\"quo\\te\"\n", "ü", "\xEF\xBF\xBD", "\xEF\xBF\xBD-2"};
  ASSERT_EQ(read.surfaces.size(), names.size());
  for (std::size_t i = 0; i < names.size(); ++i) {
    EXPECT_EQ(read.materials[i].name, expected[i]);
    EXPECT_EQ(read.surfaces[i].material, scene.surfaces[i].material);
    EXPECT_EQ(read.surfaces[i].two_sided, scene.surfaces[i].two_sided);
  }
  EXPECT_EQ(read.surfaces[0].name, "surface");
  EXPECT_EQ(read.surfaces[3].name, "a-2-2");
  expect_same_polygons(read, scene);
}

/// Surfaces that share vertices and take turns in the list of polygons, one without any.
TEST_F(SceneWriter, SortsPolygonsBySurface) {
  Scene scene = make_scene();
  scene.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 5, 5}};
  scene.vertices.push_back({9, 9, 9});  // of no polygon
  scene.surfaces = {{"floor", 0, false}, {"nothing", 0, false}, {"wall", 0, true}};
  scene.add_polygon(std::vector<std::int32_t>{3, 0, 1}, 2);
  scene.add_polygon(std::vector<std::int32_t>{1, 3, 2, 0}, 0);
  const Scene read = written_and_read(scene);
  EXPECT_EQ(read.polygon_surface, (std::vector<std::int32_t>{0, 0, 1}));
  ASSERT_EQ(read.surfaces.size(), 2U);
  EXPECT_EQ(read.surfaces[1].name, "wall");
  EXPECT_EQ(read.vertices.size(), 4U + 3U);
  Scene sorted = sorted_by_surface(scene);
  for (auto& surface : sorted.polygon_surface) surface = surface == 2 ? 1 : 0;
  expect_same_polygons(read, sorted);
}

TEST_F(SceneWriter, WritesManyPolygons) {
  Scene scene = make_scene();
  constexpr int kSide = 200;
  for (int j = 0; j <= kSide; ++j) {
    for (int i = 0; i <= kSide; ++i) scene.vertices.emplace_back(i / 3., j / 7., 0);
  }
  for (int j = 0; j < kSide; ++j) {
    for (int i = 0; i < kSide; ++i) {
      const int corner = 3 + j * (kSide + 1) + i;
      scene.add_polygon(
          std::vector<std::int32_t>{corner, corner + 1, corner + kSide + 2, corner + kSide + 1}, 0);
    }
  }
  const Scene read = written_and_read(scene);
  EXPECT_EQ(read.vertices, scene.vertices);
  EXPECT_EQ(read.corners, scene.corners);
}

TEST_F(SceneWriter, TellsThatItCannotWrite) {
  const Scene scene = make_scene();
  try {
    io::write_scene(folder() / "gone" / "scene.json", scene);
    ADD_FAILURE() << "was written";
  } catch (const OutputError& error) {
    EXPECT_CONTAINS(error.what(), "scene.json");
  }
  io::write_scene(folder() / "scene.json", scene);
  const std::string before = test::file_bytes(folder() / "scene.json");
  {
    const SmallDisk disk(100);
    EXPECT_THROW(io::write_scene(folder() / "scene.json", scene), OutputError);
  }
  EXPECT_EQ(test::file_bytes(folder() / "scene.json"), before);
  EXPECT_EQ(file_names(), std::set<std::string>{"scene.json"});
}

}  // namespace
