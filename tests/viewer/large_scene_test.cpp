// What stands for scenes of very many patches: a coarse mesh, pictures by rays, rows and colours
// that are found in the background.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <stop_token>
#include <tuple>
#include <utility>

#include "io/picture/color_map.h"
#include "io/scene/scene_file.h"
#include "meshing/patches/patches.h"
#include "radiosity/base/error.h"
#include "radiosity/base/parallel.h"
#include "tests/support/shapes.h"
#include "tests/viewer/sessions.h"
#include "viewer/desk/coarse_mesh.h"
#include "viewer/desk/desk.h"
#include "viewer/desk/ray_picture.h"
#include "viewer/draw/painter.h"

namespace {

using radiosity::Index;
using radiosity::PatchMesh;
using radiosity::Vec3;
using radiosity::Visibility;
using viewer::CoarseMesh;
using viewer::CornerColors;
using namespace radiosity::test;

PatchMesh box_patches(Index n) {
  return meshing::make_patches(io::read_scene(kBox), {.n_patches = n});
}

double area_of(const CoarseMesh& coarse) {
  double area = 0;
  for (const auto& [a, b, c] : coarse.triangles()) {
    const auto& p = coarse.positions();
    area += 0.5 * (p[b] - p[a]).cross(p[c] - p[a]).norm();
  }
  return area;
}

double area_of(const PatchMesh& mesh) {
  double area = 0;
  for (const double a : mesh.area) area += a;
  return area;
}

/// Whether a triangle that faces that way holds a point, but for `near`, m.
bool is_covered(const CoarseMesh& coarse, const Vec3& point, const Vec3& normal, double near) {
  const auto& p = coarse.positions();
  return std::any_of(coarse.triangles().begin(), coarse.triangles().end(), [&](const auto& t) {
    const Vec3 across = (p[t[1]] - p[t[0]]).cross(p[t[2]] - p[t[0]]).normalized();
    if (across.dot(normal) < 0.99 || std::abs(across.dot(point - p[t[0]])) > near) return false;
    for (int k = 0; k < 3; ++k) {
      const Vec3 side = p[t[(k + 1) % 3]] - p[t[k]];
      if (side.normalized().cross(point - p[t[k]]).dot(across) < -near) return false;
    }
    return true;
  });
}

// However few triangles stand for them, polygons keep their corners, and nothing can be seen
// through them.
TEST(CoarseMesh, CoversPolygonsAndKeepsTheirCorners) {
  const PatchMesh mesh = box_patches(20'000);
  const CoarseMesh coarse(mesh, 1000);
  EXPECT_LT(coarse.triangles().size(), 6000U);
  EXPECT_GT(coarse.triangles().size(), 1000U);
  ASSERT_EQ(coarse.has_back().size(), coarse.triangles().size());
  const auto less = [](const Vec3& a, const Vec3& b) {
    return std::tie(a.x(), a.y(), a.z()) < std::tie(b.x(), b.y(), b.z());
  };
  const std::set<Vec3, decltype(less)> kept(coarse.positions().begin(), coarse.positions().end(),
                                            less);
  for (const Vec3& corner : mesh.polygon_corners) EXPECT_TRUE(kept.contains(corner));
  // One wall of the file is 3 mm off its plane, in a box of half a metre.
  constexpr double kOffPlane = 3.2e-3;
  for (Index i = 0; i < mesh.size(); i += 37) {
    EXPECT_TRUE(is_covered(coarse, mesh.centroid[i], mesh.normal[i], kOffPlane)) << i;
  }
}

/// A sphere of n x 2 n facets, each a polygon of its own, seen from outside.
PatchMesh sphere(int n) {
  PatchMesh mesh;
  const auto at = [&](int row, int column) -> Vec3 {
    const double polar = radiosity::kPi * row / n;
    const double around = radiosity::kPi * (column % (2 * n)) / n;
    return {std::sin(polar) * std::cos(around), std::sin(polar) * std::sin(around),
            std::cos(polar)};
  };
  mesh.surface_names = {"sphere"};
  mesh.surface_two_sided = {false};
  std::int32_t polygon = 0;
  for (int row = 0; row < n; ++row) {
    for (int column = 0; column < 2 * n; ++column) {
      const auto first = static_cast<std::int32_t>(mesh.vertices.size());
      const bool is_top = row == 0;
      const bool is_bottom = row == n - 1;
      mesh.vertices.push_back(at(row, column));
      mesh.vertices.push_back(at(row + 1, column));
      if (!is_bottom) mesh.vertices.push_back(at(row + 1, column + 1));
      if (!is_top) mesh.vertices.push_back(at(row, column + 1));
      const std::int32_t fourth = is_top || is_bottom ? -1 : first + 3;
      mesh.add_patch({first, first + 1, first + 2, fourth}, 0, polygon++);
    }
  }
  return mesh;
}

// Where each polygon is small, surfaces are taken together across them.
TEST(CoarseMesh, TakesSmallPolygonsTogether) {
  const PatchMesh mesh = sphere(100);
  const CoarseMesh coarse(mesh, 1000);
  EXPECT_LT(coarse.triangles().size(), 6000U);
  for (const Vec3& position : coarse.positions()) EXPECT_NEAR(position.norm(), 1, 1e-12);
  // Chords of cells 0.1 wide.
  EXPECT_NEAR(area_of(coarse), area_of(mesh), 0.05 * area_of(mesh));
}

TEST(CoarseMesh, HasTheMeansOfColours) {
  const PatchMesh mesh = box_patches(2000);
  const CoarseMesh coarse(mesh, 200);
  const std::size_t n_slots = 4 * mesh.corners.size();
  for (const io::Rgb& color : coarse.colors(std::vector<io::Rgb>(n_slots, io::Rgb{7, 99, 255}))) {
    EXPECT_EQ(color, (io::Rgb{7, 99, 255}));
  }
  for (const float value : coarse.values(std::vector<float>(n_slots, 0.25F))) {
    EXPECT_EQ(value, 0.25F);
  }
  for (const float value : coarse.values(std::vector<float>(n_slots, -1.F))) {
    EXPECT_LT(value, 0);
  }
}

/// A square of n x n patches that fills a picture but for its border, seen by a camera before it.
struct Square {
  explicit Square(int n) {
    add_grid(mesh, Vec3(-1, -1, 0), 2 * Vec3::UnitX(), 2 * Vec3::UnitY(), n, n);
    visibility.emplace(mesh);
    camera.position = Vec3(0, 0, 1.25);
    camera.direction = -Vec3::UnitZ();
    camera.vertical_fov = radiosity::kPi / 2;
  }
  [[nodiscard]] io::RgbPicture picture(const CornerColors& corners,
                                       const viewer::RayPictureOptions& options) const {
    return viewer::ray_picture(mesh, *visibility, corners, camera, options);
  }
  PatchMesh mesh;
  std::optional<Visibility> visibility;
  radiosity::Camera camera;
};

io::Rgb pixel(const io::RgbPicture& picture, int x, int y) {
  const std::uint8_t* first = picture.bytes.data() + 3 * (y * picture.width + x);
  return {first[0], first[1], first[2]};
}

// What varies linearly over the patches is blended exactly, so that pixels have the colours of
// their places.
TEST(RayPicture, HasTheColoursOfPlaces) {
  const Square square(7);
  CornerColors corners;
  for (Index i = 0; i < square.mesh.size(); ++i) {
    for (int k = 0; k < 4; ++k) {
      const double value = 0.5 + 0.4 * square.mesh.corner(i, k).x();
      corners.positions.push_back(static_cast<float>(value));
    }
  }
  const io::RgbPicture picture = square.picture(corners, {.width = 50, .height = 50});
  ASSERT_EQ(picture.bytes.size(), 3U * 50 * 50);
  for (int x = 0; x < 50; ++x) {
    const double place = 1.25 * (2 * (x + 0.5) / 50 - 1);  // m
    const bool is_inside = std::abs(place) < 1;
    const io::Rgb expected =
        is_inside ? io::map_color(0.5 + 0.4 * place) : viewer::kBackgroundColor;
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(pixel(picture, x, 25)[c], expected[c], 1) << x;
  }
}

TEST(RayPicture, TellsBacksAndWhatIsNotKnown) {
  Square square(3);
  const CornerColors unknown{.colors = {}, .positions = std::vector<float>(36, -1.F)};
  EXPECT_EQ(pixel(square.picture(unknown, {.width = 9, .height = 9}), 4, 4), viewer::kUnknownColor);
  square.camera.position = -square.camera.position;
  square.camera.direction = Vec3::UnitZ();
  const CornerColors white{.colors = std::vector<io::Rgb>(36, io::Rgb{255, 255, 255}),
                           .positions = {}};
  EXPECT_EQ(pixel(square.picture(white, {.width = 9, .height = 9}), 4, 4),
            viewer::kBackgroundColor);
  EXPECT_EQ(pixel(square.picture(white, {.width = 9, .height = 9, .hides_backs = false}), 4, 4),
            viewer::kBackColor);
}

TEST(RayPicture, ShowsEdgesWhereTheyCanBeTold) {
  const CornerColors white{.colors = std::vector<io::Rgb>(4 * 100, io::Rgb{255, 255, 255}),
                           .positions = {}};
  const Square square(10);
  const auto n_dark = [&](int size) {
    const io::RgbPicture picture =
        square.picture(white, {.width = size, .height = size, .has_edges = true});
    int n = 0;
    for (int x = 0; x < size; ++x) n += pixel(picture, x, size / 2 + 3) == viewer::kEdgeColor;
    return n;
  };
  EXPECT_EQ(n_dark(20), 0);  // 1.6 pixels a patch
  // Eleven edges across, each of about a pixel.
  EXPECT_NEAR(n_dark(300), 11, 2);
}

TEST(RayPicture, IsTheSameWithAnyNumberOfThreadsAndCanBeStopped) {
  const PatchMesh mesh = box_patches(500);
  const Visibility visibility(mesh);
  CornerColors corners;
  for (Index slot = 0; slot < 4 * mesh.size(); ++slot) {
    corners.colors.push_back({static_cast<std::uint8_t>(slot), 100, 50});
  }
  const radiosity::Camera camera = *io::read_scene(kBox).camera;
  viewer::RayPictureOptions options{.width = 40, .height = 30, .samples = 2};
  const auto with_all = viewer::ray_picture(mesh, visibility, corners, camera, options);
  const radiosity::ThreadLimit one(1);
  EXPECT_EQ(viewer::ray_picture(mesh, visibility, corners, camera, options).bytes, with_all.bytes);
  std::stop_source source;
  source.request_stop();
  options.progress.stop = source.get_token();
  EXPECT_THROW(viewer::ray_picture(mesh, visibility, corners, camera, options),
               radiosity::Interrupted);
}

// A row of a compressed operator takes a product: the window does not wait for it.
TEST(Session, FindsRowsOfCompressedOperatorsInTheBackground) {
  viewer::Desk desk({.patches = {.n_patches = 600},
                     .tolerance = 0.05,
                     .transport = radiosity::TransportKind::compressed});
  open(desk.session, kBox);
  desk.session.select(123);
  EXPECT_EQ(desk.session.row(), nullptr);
  EXPECT_FALSE(desk.session.is_idle());
  viewer::update(desk);
  ASSERT_TRUE(desk.facts);
  wait_until(desk.session, [&] { return desk.session.is_idle(); });
  viewer::update(desk);
  ASSERT_NE(desk.session.row(), nullptr);
  const radiosity::FactorRows& rows = rows_of(*desk.session.model().transport);
  EXPECT_EQ(desk.session.row()->factors, rows.row(123));
  ASSERT_TRUE(desk.facts && desk.facts->has_factors);
  const Eigen::VectorXd errors = rows.row_error(123);
  ASSERT_FALSE(desk.facts->partners.empty());
  for (const viewer::Partner& partner : desk.facts->partners) {
    EXPECT_NEAR(partner.error, errors[partner.patch], 1e-9 * errors.maxCoeff());
  }
  desk.session.select(std::nullopt);
  EXPECT_EQ(desk.session.row(), nullptr);
}

// Nor does it for what takes a sum over very many patches; another question puts the first one
// away.
TEST(Desk, SumsUpWhatIsToldOfAPatchInTheBackground) {
  viewer::Desk desk({.patches = {.n_patches = 32'000}, .tolerance = 0.05});
  open(desk.session, std::string(RADIOSITY_SCENES) + "/opposed-squares.json");
  const PatchMesh& mesh = *desk.session.model().mesh;
  ASSERT_GT(mesh.size(), 30'000);
  viewer::update(desk);
  const Index target = mesh.size() - 1;
  desk.session.select(target - 7);
  settle(desk.session);
  viewer::update(desk);
  EXPECT_TRUE(desk.summing.is_busy());
  EXPECT_FALSE(desk.facts->is_summed);
  desk.session.select(target);
  settle(desk.session);
  wait_until(desk.session, [&] {
    viewer::update(desk);
    EXPECT_EQ(desk.facts->patch, target);
    return desk.facts->is_summed;
  });
  ASSERT_EQ(desk.facts->arrivals.size(), 1U);
  const Eigen::VectorXd& row = desk.session.row()->factors;
  const double expected = row.dot(desk.session.light()->solution.radiosity.col(0));
  EXPECT_NEAR(desk.facts->arrivals[0].irradiance[0], expected, 1e-9 * expected);
  EXPECT_EQ(desk.facts->direct.size(), 1);
  desk.session.select(std::nullopt);
  viewer::update(desk);
  EXPECT_FALSE(desk.facts || desk.summing.is_busy());
}

// The sum of the lamps' lights comes first, before it is solved anew.
TEST(SolveLight, TellsTheSumOfSeparateLightsFirst) {
  viewer::Session session(coarse());
  open(session, kRoom);
  const auto& model = session.model();
  viewer::LightMix mix = session.mix();
  std::shared_ptr<const viewer::EmitterLights> separated;
  const viewer::LightEvents separating = {
      .lit = [](const viewer::Light&) {},
      .separated =
          [&](viewer::EmitterLights lights) {
            separated = std::make_shared<const viewer::EmitterLights>(std::move(lights));
          },
      .warned = [](const std::string&) {}};
  viewer::solve_light(model, mix, {}, separating, {});
  ASSERT_NE(separated, nullptr);
  mix.emitters.at(0).scale = 0.3;
  std::vector<viewer::Light> lights;
  const viewer::LightEvents events = {
      .lit = [&](viewer::Light light) { lights.push_back(std::move(light)); },
      .separated = {},
      .warned = [](const std::string&) {}};
  viewer::solve_light(model, mix,
                      {.irradiance = {}, .is_separation_wanted = false, .separated = separated},
                      events, {});
  ASSERT_EQ(lights.size(), 3U);
  EXPECT_EQ(lights[0].kind, viewer::Light::Kind::solved);
  EXPECT_EQ(lights[0].solution.radiosity, viewer::superpose(*separated, mix).radiosity);
  EXPECT_EQ(lights[2].kind, viewer::Light::Kind::complete);
  EXPECT_LE((lights[0].solution.radiosity - lights[2].solution.radiosity).norm(),
            1e-6 * lights[2].solution.radiosity.norm());
  EXPECT_TRUE(lights[2].relative_error.has_value());
}

// The picture is there once nothing moves, and gone while the camera does.
TEST(LargePainter, DrawsAPictureOnceNothingMoves) {
  viewer::Desk desk(
      {.patches = {.n_patches = 40'000}, .transport = radiosity::TransportKind::compressed});
  viewer::SceneView view;
  viewer::Painter painter;
  desk.session.open(kBox);
  wait_until(desk.session, [&] { return desk.session.is_open(); });
  desk.session.stop();
  viewer::update(desk);
  desk.region = {.left = 0, .top = 0, .width = 64, .height = 48};
  ASSERT_GT(desk.session.model().mesh->size(), viewer::kMostDrawn);
  const auto paint = [&] {
    wait_until(desk.session, [&] {
      painter.update();
      viewer::update(desk);
      painter.paint(desk, view);
      return painter.is_done(desk);
    });
  };
  paint();
  ASSERT_NE(painter.still(), nullptr);
  EXPECT_EQ(painter.still()->width, 64);
  EXPECT_EQ(painter.still()->height, 48);
  const auto before = painter.still();
  painter.paint(desk, view);
  EXPECT_EQ(painter.still(), before);
  desk.camera.orbit(0.3, 0);
  painter.paint(desk, view);
  EXPECT_EQ(painter.still(), nullptr);
  EXPECT_FALSE(painter.is_done(desk));
  paint();
  EXPECT_NE(painter.still()->bytes, before->bytes);
  // Something else to show: its legend comes with it.
  EXPECT_FALSE(desk.legend);
  EXPECT_FALSE(desk.is_painting_due);
  viewer::show(desk, "area");
  EXPECT_FALSE(painter.is_done(desk));
  painter.paint(desk, view);
  EXPECT_TRUE(desk.is_painting_due);
  paint();
  EXPECT_FALSE(desk.is_painting_due);
  ASSERT_TRUE(desk.legend);
  EXPECT_EQ(desk.legend->values.size(), desk.session.model().mesh->size());
}

}  // namespace
