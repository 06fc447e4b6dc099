#include "meshing/patches/patches.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <random>
#include <set>
#include <sstream>
#include <string>

#include "radiosity/base/error.h"
#include "radiosity/scene/patch_mesh.h"
#include "tests/support/messages.h"

namespace {

using meshing::make_patches;
using radiosity::Index;
using radiosity::kPi;
using radiosity::MeshError;
using radiosity::PatchMesh;
using radiosity::Scene;
using radiosity::Vec3;
using radiosity::test::expect_contains;
using Polygon = std::vector<Vec3>;

/// Each polygon with vertices of its own, so that only positions tell what is shared.
void add_polygon(Scene& scene, const Polygon& polygon, std::int32_t surface = 0) {
  std::vector<std::int32_t> corners;
  for (const Vec3& p : polygon) {
    corners.push_back(static_cast<std::int32_t>(scene.vertices.size()));
    scene.vertices.push_back(p);
  }
  scene.add_polygon(corners, surface);
}

Scene make_scene(const std::vector<Polygon>& polygons) {
  Scene scene;
  scene.surfaces.push_back({.name = "wall", .material = 0, .two_sided = false});
  for (const Polygon& p : polygons) add_polygon(scene, p);
  return scene;
}

/// Six quads, normals inwards.
std::vector<Polygon> box(const Vec3& size) {
  const double x = size.x();
  const double y = size.y();
  const double z = size.z();
  return {
      {{0, 0, 0}, {x, 0, 0}, {x, y, 0}, {0, y, 0}}, {{0, 0, z}, {0, y, z}, {x, y, z}, {x, 0, z}},
      {{0, 0, 0}, {0, 0, z}, {x, 0, z}, {x, 0, 0}}, {{0, y, 0}, {x, y, 0}, {x, y, z}, {0, y, z}},
      {{0, 0, 0}, {0, y, 0}, {0, y, z}, {0, 0, z}}, {{x, 0, 0}, {x, 0, z}, {x, y, z}, {x, y, 0}}};
}

/// A room with an L-shaped floor and ceiling (concave hexagons), normals inwards.
std::vector<Polygon> l_room() {
  const std::vector<std::pair<double, double>> plan{{0, 0}, {4, 0}, {4, 2}, {2, 2}, {2, 5}, {0, 5}};
  constexpr double kHeight = 2.5;
  Polygon floor;
  Polygon ceiling;
  for (const auto& [x, y] : plan) floor.emplace_back(x, y, 0);
  for (auto p = plan.rbegin(); p != plan.rend(); ++p)
    ceiling.emplace_back(p->first, p->second, kHeight);
  std::vector<Polygon> room{floor, ceiling};
  for (std::size_t k = 0; k < plan.size(); ++k) {
    const auto& [x0, y0] = plan[k];
    const auto& [x1, y1] = plan[(k + 1) % plan.size()];
    room.push_back({{x1, y1, 0}, {x0, y0, 0}, {x0, y0, kHeight}, {x1, y1, kHeight}});
  }
  return room;
}

/// A flat sheet of n x n jittered cells, each a quad or two triangles.
std::vector<Polygon> jittered_sheet(int n, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> jitter(-0.2, 0.2);
  std::vector<Vec3> grid;
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n; ++i) grid.emplace_back(i + jitter(random), j + jitter(random), 0.0);
  }
  std::vector<Polygon> sheet;
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      const Vec3& a = grid[j * (n + 1) + i];
      const Vec3& b = grid[j * (n + 1) + i + 1];
      const Vec3& c = grid[(j + 1) * (n + 1) + i + 1];
      const Vec3& d = grid[(j + 1) * (n + 1) + i];
      if (random() % 2 == 0) {
        sheet.push_back({a, b, c, d});
      } else {
        sheet.push_back({a, b, c});
        sheet.push_back({a, c, d});
      }
    }
  }
  return sheet;
}

double area(const Polygon& polygon) { return radiosity::vector_area(polygon).norm(); }

double total_area(const PatchMesh& mesh) {
  double sum = 0;
  for (const double a : mesh.area) sum += a;
  return sum;
}

double total_area(const std::vector<Polygon>& polygons) {
  double sum = 0;
  for (const Polygon& p : polygons) sum += area(p);
  return sum;
}

struct Quality {
  double longest_edge = 0;
  double smallest_angle = kPi;
  double largest_quad_aspect = 1;
};

Quality quality(const PatchMesh& mesh) {
  Quality q;
  for (Index i = 0; i < mesh.size(); ++i) {
    const int n = mesh.n_corners(i);
    double longest = 0;
    double shortest = std::numeric_limits<double>::infinity();
    for (int k = 0; k < n; ++k) {
      const Vec3 next = mesh.corner(i, (k + 1) % n) - mesh.corner(i, k);
      const Vec3 previous = mesh.corner(i, (k + n - 1) % n) - mesh.corner(i, k);
      longest = std::max(longest, next.norm());
      shortest = std::min(shortest, next.norm());
      q.smallest_angle =
          std::min(q.smallest_angle, std::atan2(next.cross(previous).norm(), next.dot(previous)));
    }
    q.longest_edge = std::max(q.longest_edge, longest);
    if (n == 4) q.largest_quad_aspect = std::max(q.largest_quad_aspect, longest / shortest);
  }
  return q;
}

/// How many patches use each edge, by vertex indices.
std::map<std::pair<int, int>, int> edge_uses(const PatchMesh& mesh) {
  std::map<std::pair<int, int>, int> uses;
  for (Index i = 0; i < mesh.size(); ++i) {
    const int n = mesh.n_corners(i);
    for (int k = 0; k < n; ++k) {
      const int a = mesh.corners[i][k];
      const int b = mesh.corners[i][(k + 1) % n];
      ++uses[{std::min(a, b), std::max(a, b)}];
    }
  }
  return uses;
}

void expect_closed(const PatchMesh& mesh) {
  long n_wrong = 0;
  for (const auto& [edge, n] : edge_uses(mesh)) n_wrong += n != 2 ? 1 : 0;
  EXPECT_EQ(n_wrong, 0) << "of " << mesh.size() << " patches";
  // Divergence theorem: the vector areas of a closed surface add up to nothing.
  Vec3 sum = Vec3::Zero();
  for (Index i = 0; i < mesh.size(); ++i) sum += mesh.area[i] * mesh.normal[i];
  EXPECT_LT(sum.norm(), 1e-12 * total_area(mesh));
}

std::string mesh_error(const Scene& scene, const meshing::PatchOptions& options = {}) {
  try {
    make_patches(scene, options);
  } catch (const MeshError& e) {
    return e.what();
  }
  return "no error";
}

/// Vertices and faces of an OBJ file; nothing else of it.
Scene read_simple_obj(const std::string& path) {
  Scene scene;
  scene.surfaces.push_back({.name = "all", .material = 0, .two_sided = false});
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::string kind;
    words >> kind;
    if (kind == "v") {
      Vec3 p;
      words >> p.x() >> p.y() >> p.z();
      scene.vertices.push_back(0.001 * p);
    } else if (kind == "f") {
      std::vector<std::int32_t> corners;
      for (int v = 0; words >> v;) corners.push_back(v - 1);
      scene.add_polygon(corners, 0);
    }
  }
  return scene;
}

TEST(AsIs, KeepsOrderAndCorners) {
  const std::vector<Polygon> polygons{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                                      {{5, 0, 0}, {6, 0, 0}, {6, 1, 0}, {5, 1, 0}},
                                      {{0, 0, 3}, {0, 1, 3}, {1, 1, 3}}};
  const PatchMesh mesh = make_patches(make_scene(polygons));
  ASSERT_EQ(mesh.size(), 3);
  for (Index i = 0; i < 3; ++i) {
    EXPECT_EQ(mesh.polygon[i], i);
    EXPECT_EQ(mesh.surface[i], 0);
    EXPECT_EQ(mesh.twin[i], -1);
    ASSERT_EQ(mesh.n_corners(i), static_cast<int>(polygons[i].size()));
    for (int k = 0; k < mesh.n_corners(i); ++k) EXPECT_EQ(mesh.corner(i, k), polygons[i][k]);
  }
  EXPECT_EQ(mesh.surface_names, std::vector<std::string>{"wall"});
}

TEST(AsIs, WeldsEqualPositions) {
  EXPECT_EQ(make_patches(make_scene(box({1, 2, 3}))).vertices.size(), 8U);
  const Scene zeros = make_scene({{{0.0, 0, 0}, {1, 0, 0}, {0, 1, 0}},  //
                                  {{-0.0, 0, 0}, {0, 1, 0}, {-1, 0, 0}}});
  EXPECT_EQ(make_patches(zeros).vertices.size(), 4U);
}

/// Six digits of a turned box put the corners of its faces off their planes.
TEST(AsIs, RoundedQuadsStayQuadsIfThePrecisionIsKnown) {
  const Eigen::AngleAxisd turn(0.7, Vec3(1, 2, 3).normalized());
  Scene scene = make_scene(box(Vec3(1.23, 2.34, 3.45)));
  for (Vec3& vertex : scene.vertices) {
    vertex = turn * vertex;
    for (double& x : vertex) x = 1e-5 * std::round(1e5 * x);
  }
  EXPECT_GT(make_patches(scene).size(), 6);
  scene.precision = 0.5e-5;
  EXPECT_EQ(make_patches(scene).size(), 6);
  EXPECT_EQ(make_patches(scene).precision, 0.5e-5);
}

TEST(AsIs, PatchesKnowTheOutlinesOfTheirPolygons) {
  for (const double max_edge : {10.0, 0.7}) {
    const Scene scene = make_scene(l_room());
    const PatchMesh mesh = make_patches(scene, {.max_edge = max_edge});
    ASSERT_EQ(mesh.n_polygons(), scene.n_polygons());
    const PatchMesh moved = radiosity::centered(mesh);
    for (Index i = 0; i < scene.n_polygons(); ++i) {
      ASSERT_EQ(mesh.outline(i).size(), scene.polygon(i).size());
      for (std::size_t k = 0; k < mesh.outline(i).size(); ++k) {
        const Vec3& corner = scene.vertices[scene.polygon(i)[k]];
        EXPECT_EQ(mesh.outline(i)[k], corner);
        EXPECT_EQ(moved.outline(i)[k], corner - radiosity::bounds(mesh).center());
      }
    }
  }
}

TEST(AsIs, CornellPatchesOfTheNonPlanarWallAreHalved) {
  const Scene scene = read_simple_obj(RADIOSITY_TEST_DATA "/cornell-box/patches-8x8.obj");
  ASSERT_EQ(scene.n_polygons(), 480);
  const PatchMesh mesh = make_patches(scene);
  EXPECT_EQ(mesh.size(), 544);
  EXPECT_TRUE(std::is_sorted(mesh.polygon.begin(), mesh.polygon.end()));
  const std::set<std::int32_t> polygons(mesh.polygon.begin(), mesh.polygon.end());
  EXPECT_EQ(polygons.size(), 480U);
  EXPECT_EQ(*polygons.begin(), 0);
  EXPECT_EQ(*polygons.rbegin(), 479);
  for (Index i = 0; i < mesh.size(); ++i) EXPECT_GT(mesh.area[i], 0);
}

TEST(AsIs, ConcaveQuadGivesTwoTrianglesInside) {
  const Polygon dart{{0, 0, 0}, {2, -1, 0}, {0.5, 0, 0}, {2, 1, 0}};
  for (int shift = 0; shift < 4; ++shift) {
    Polygon turned = dart;
    std::rotate(turned.begin(), turned.begin() + shift, turned.end());
    const PatchMesh mesh = make_patches(make_scene({turned}));
    ASSERT_EQ(mesh.size(), 2);
    EXPECT_NEAR(total_area(mesh), area(dart), 1e-15);
    for (const Vec3& n : mesh.normal) EXPECT_GT(n.z(), 0.999);
  }
}

TEST(AsIs, PolygonKeepsCornersInTheMiddleOfEdges) {
  const PatchMesh mesh = make_patches(
      make_scene({{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 2, 0}, {1, 2, 0}, {0, 2, 0}, {0, 1, 0}}}));
  EXPECT_EQ(mesh.size(), 5);
  EXPECT_NEAR(total_area(mesh), 4, 1e-14);
  const auto uses = edge_uses(mesh);
  EXPECT_EQ(std::count_if(uses.begin(), uses.end(), [](const auto& u) { return u.second == 1; }),
            7);
  for (const double a : mesh.area) EXPECT_GT(a, 0.4);
}

TEST(AsIs, PolygonWithSlitToAHole) {
  const Polygon frame{{0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {0, 3, 0}, {0, 0, 0},
                      {1, 1, 0}, {1, 2, 0}, {2, 2, 0}, {2, 1, 0}, {1, 1, 0}};
  const PatchMesh mesh = make_patches(make_scene({frame}));
  EXPECT_EQ(mesh.size(), 8);
  EXPECT_NEAR(total_area(mesh), 8, 1e-13);
  for (const Vec3& n : mesh.normal) EXPECT_GT(n.z(), 0.999);
  const PatchMesh fine = make_patches(make_scene({frame}), {.max_edge = 0.4});
  EXPECT_NEAR(total_area(fine), 8, 1e-12);
}

TEST(AsIs, RepeatedCornersCountOnce) {
  const PatchMesh mesh = make_patches(make_scene({{{0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {0, 1, 0}}}));
  ASSERT_EQ(mesh.size(), 1);
  EXPECT_EQ(mesh.n_corners(0), 3);
}

TEST(AsIs, RandomStarShapedPolygons) {
  constexpr unsigned kSeed = 7;
  std::mt19937 random(kSeed);
  SCOPED_TRACE("seed 7");
  std::uniform_real_distribution<double> radius(0.2, 1.0);
  for (int round = 0; round < 100; ++round) {
    const int n = 5 + static_cast<int>(random() % 40);
    Polygon star;
    for (int k = 0; k < n; ++k) {
      const double r = radius(random);
      star.emplace_back(r * std::cos(2 * kPi * k / n), r * std::sin(2 * kPi * k / n), 0.3);
    }
    const PatchMesh mesh = make_patches(make_scene({star}));
    ASSERT_EQ(mesh.size(), n - 2);
    EXPECT_NEAR(total_area(mesh), area(star), 1e-13);
    for (const Vec3& normal : mesh.normal) EXPECT_GT(normal.z(), 0.999);
  }
}

TEST(MaxEdge, BoxBecomesRegularGrids) {
  const PatchMesh mesh = make_patches(make_scene(box({1, 2, 3})), {.max_edge = 0.25});
  EXPECT_EQ(mesh.size(), 2 * (4 * 8 + 4 * 12 + 8 * 12));
  for (Index i = 0; i < mesh.size(); ++i) {
    EXPECT_EQ(mesh.n_corners(i), 4);
    EXPECT_NEAR(mesh.area[i], 0.0625, 1e-15);
  }
  expect_closed(mesh);
}

TEST(MaxEdge, RoundingDoesNotCostAPiece) {
  // 0.7 / 0.1 is 6.999... and 0.3 / 0.1 is 2.999..., 0.6 / 0.05 is 11.999...: all meant to be
  // whole.
  EXPECT_EQ(make_patches(make_scene({{{0, 0, 0}, {0.7, 0, 0}, {0.7, 0.3, 0}, {0, 0.3, 0}}}),
                         {.max_edge = 0.1})
                .size(),
            21);
}

TEST(MaxEdge, EquilateralTriangleBecomesSimilarOnes) {
  const PatchMesh mesh = make_patches(
      make_scene({{{0, 0, 0}, {1, 0, 0}, {0.5, std::sqrt(0.75), 0}}}), {.max_edge = 0.1});
  EXPECT_EQ(mesh.size(), 100);
  EXPECT_NEAR(quality(mesh).smallest_angle, kPi / 3, 1e-12);
}

class EachMaxEdge : public testing::TestWithParam<double> {};

TEST_P(EachMaxEdge, ConcaveRoomStaysClosed) {
  const std::vector<Polygon> room = l_room();
  const PatchMesh mesh = make_patches(make_scene(room), {.max_edge = GetParam()});
  expect_closed(mesh);
  EXPECT_NEAR(total_area(mesh) / total_area(room), 1, 1e-12);
  const Quality q = quality(mesh);
  EXPECT_LE(q.longest_edge, GetParam() * (1 + 1e-11));
  EXPECT_GT(q.smallest_angle, 20 * kPi / 180);
  EXPECT_LE(q.largest_quad_aspect, 2.5);
}

TEST_P(EachMaxEdge, MixedSheetConforms) {
  const std::vector<Polygon> sheet = jittered_sheet(8, 3);
  SCOPED_TRACE("seed 3");
  const PatchMesh mesh = make_patches(make_scene(sheet), {.max_edge = GetParam()});
  EXPECT_NEAR(total_area(mesh) / total_area(sheet), 1, 1e-12);
  const auto uses = edge_uses(mesh);
  // Every edge of one patch lies on the rim of the sheet, and the rim is all there.
  double rim = 0;
  for (const auto& [edge, n] : uses) {
    EXPECT_LE(n, 2);
    if (n == 1) rim += (mesh.vertices[edge.first] - mesh.vertices[edge.second]).norm();
  }
  double expected_rim = 0;
  std::map<std::pair<std::pair<double, double>, std::pair<double, double>>, int> sides;
  for (const Polygon& p : sheet) {
    for (std::size_t k = 0; k < p.size(); ++k) {
      const Vec3& a = p[k];
      const Vec3& b = p[(k + 1) % p.size()];
      const std::pair<double, double> from{a.x(), a.y()};
      const std::pair<double, double> to{b.x(), b.y()};
      const int n = ++sides[{std::min(from, to), std::max(from, to)}];
      expected_rim += n == 1 ? (b - a).norm() : -(b - a).norm();
    }
  }
  EXPECT_NEAR(rim / expected_rim, 1, 1e-12);
  const Quality q = quality(mesh);
  EXPECT_LE(q.longest_edge, GetParam() * (1 + 1e-11));
  EXPECT_GT(q.smallest_angle, 15 * kPi / 180);
}

INSTANTIATE_TEST_SUITE_P(Lengths, EachMaxEdge, testing::Values(1.7, 0.9, 0.5, 0.21));

TEST(MaxEdge, WallThatIsNotPlanarFitsItsNeighbours) {
  // The Cornell box's way: one corner of one wall is off its plane.
  std::vector<Polygon> room = box({1, 1, 1});
  for (Polygon& p : room) {
    for (Vec3& v : p) {
      if (v == Vec3(1, 1, 1)) v = Vec3(1.01, 1, 1);
    }
  }
  for (const double length : {2.0, 0.4, 0.15}) {
    const PatchMesh mesh = make_patches(make_scene(room), {.max_edge = length});
    expect_closed(mesh);
    EXPECT_LE(quality(mesh).longest_edge, length * (1 + 1e-11));
    EXPECT_GT(quality(mesh).smallest_angle, 30 * kPi / 180);
  }
}

TEST(MaxEdge, StripOfUnequalQuadsDoesNotSpreadItsFinestDivision) {
  // A fan of quads that grow from 0.1 to 10 m: the narrow ones need no division across.
  std::vector<Polygon> strip;
  double y = 0.1;
  double x = 0;
  for (int k = 0; k < 14; ++k) {
    const double wider = 1.4 * y;
    strip.push_back({{x, 0, 0}, {x + y, 0, 0}, {x + y, wider, 0}, {x, y, 0}});
    x += y;
    y = wider;
  }
  const PatchMesh mesh = make_patches(make_scene(strip), {.max_edge = 0.5});
  EXPECT_NEAR(total_area(mesh) / total_area(strip), 1, 1e-12);
  EXPECT_LE(quality(mesh).longest_edge, 0.5 * (1 + 1e-11));
  EXPECT_GT(quality(mesh).smallest_angle, 15 * kPi / 180);
  EXPECT_LE(std::count(mesh.polygon.begin(), mesh.polygon.end(), 0), 4);
}

TEST(MaxEdge, LongThinPolygonIsDividedAlongItsLength) {
  const PatchMesh mesh = make_patches(
      make_scene({{{0, 0, 0}, {10, 0, 0}, {10, 0.1, 0}, {0, 0.1, 0}}}), {.max_edge = 0.5});
  EXPECT_EQ(mesh.size(), 20);
}

class EachCount : public testing::TestWithParam<long> {};

TEST_P(EachCount, AboutAsManyAsAsked) {
  const auto wanted = static_cast<double>(GetParam());
  for (const std::vector<Polygon>& polygons :
       {l_room(), jittered_sheet(5, 9), box({1, 1.3, 1.7})}) {
    const PatchMesh mesh = make_patches(make_scene(polygons), {.n_patches = GetParam()});
    EXPECT_NEAR(static_cast<double>(mesh.size()), wanted, 0.1 * wanted);
  }
}

INSTANTIATE_TEST_SUITE_P(Counts, EachCount, testing::Values(200, 1000, 5000));

TEST(PatchCount, NeverFewerThanAsIs) {
  EXPECT_EQ(make_patches(make_scene(box({1, 1, 1})), {.n_patches = 2}).size(), 6);
}

TEST(PatchCount, CommensurableEdgesNeedNotStepAtOnce) {
  // In one step the box would go from 4 x 4 x 2 (64 patches) to 4 x 5 x 3 (94).
  EXPECT_EQ(make_patches(make_scene(box({4, 5, 2.5})), {.n_patches = 75}).size(), 76);
  // And the cube from 6 to 24.
  EXPECT_EQ(make_patches(make_scene(box({1, 1, 1})), {.n_patches = 15}).size(), 16);
}

TEST(PatchCount, TwinsCount) {
  Scene scene = make_scene({{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}});
  scene.surfaces[0].two_sided = true;
  EXPECT_EQ(make_patches(scene, {.n_patches = 200}).size(), 200);
}

TEST(TwoSided, TwinFollowsItsFront) {
  Scene scene = make_scene({{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}},  //
                            {{1, 0, 0}, {2, 0, 0}, {1, 1, 0}}});
  scene.surfaces[0].two_sided = true;
  scene.surfaces.push_back({.name = "floor", .material = 0, .two_sided = false});
  add_polygon(scene, {{0, 0, -1}, {1, 0, -1}, {0, 1, -1}}, 1);
  const PatchMesh mesh = make_patches(scene, {.max_edge = 0.3});
  EXPECT_EQ(mesh.surface_two_sided, (std::vector<bool>{true, false}));
  Index n_pairs = 0;
  for (Index i = 0; i < mesh.size(); ++i) {
    if (mesh.surface[i] == 1) {
      EXPECT_EQ(mesh.twin[i], -1);
      continue;
    }
    const std::int32_t twin = mesh.twin[i];
    ASSERT_EQ(mesh.twin[twin], i);
    if (i > twin) continue;
    EXPECT_EQ(twin, i + 1);
    ++n_pairs;
    EXPECT_EQ(mesh.polygon[twin], mesh.polygon[i]);
    EXPECT_EQ(mesh.area[twin], mesh.area[i]);
    EXPECT_EQ(mesh.normal[twin], Vec3(-mesh.normal[i]));
    EXPECT_EQ(mesh.centroid[twin], mesh.centroid[i]);
    EXPECT_GT(mesh.normal[i].z(), 0.999);
    const int n = mesh.n_corners(i);
    for (int k = 0; k < n; ++k) EXPECT_EQ(mesh.corners[twin][k], mesh.corners[i][n - 1 - k]);
  }
  EXPECT_GT(n_pairs, 16);
}

TEST(Errors, ZeroArea) {
  const std::vector<Polygon> bad{{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}},
                                 {{0, 0, 0}, {1, 0, 0}, {1, 0, 0}},
                                 {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}},
                                 {{1, 1, 1}, {1, 1, 1}, {1, 1, 1}},
                                 {{0, 0, 0}, {1000, 0, 0}, {500, 1e-9, 0}}};
  for (const Polygon& p : bad) {
    Scene scene = make_scene({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, p});
    scene.source = "room.obj";
    const std::string message = mesh_error(scene);
    expect_contains(message, "room.obj: surface 'wall', polygon 1: ");
    expect_contains(message, "no area");
    expect_contains(message, "remove it");
  }
  // Small is not degenerate.
  EXPECT_EQ(make_patches(make_scene({{{0, 0, 0}, {1e-6, 0, 0}, {0, 1e-6, 0}}})).size(), 1);
}

TEST(Errors, CrossingOutline) {
  const std::vector<Polygon> bad{{{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}},
                                 {{0, 0, 0}, {2, 2, 0}, {2, 0, 0}, {0, 1, 0}},
                                 {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {2, -1, 0}, {0, 4, 0}}};
  for (const Polygon& p : bad) {
    const std::string message = mesh_error(make_scene({p}));
    expect_contains(message, "surface 'wall', polygon 0: ");
    expect_contains(message, "cross");
  }
}

/// Edges divide alike whatever number of polygons meets there.
TEST(Patches, NonManifoldEdgesAreKept) {
  const std::vector<Polygon> fan{{{0, 0, 0}, {0, 0, 1}, {1, 0, 1}},
                                 {{0, 0, 0}, {0, 0, 1}, {-1, 1, 1}},
                                 {{0, 0, 1}, {0, 0, 0}, {-1, -1, 1}}};
  EXPECT_EQ(make_patches(make_scene(fan)).size(), 3);
  const PatchMesh divided = make_patches(make_scene(fan), {.max_edge = 0.3});
  double area = 0;
  for (const double a : divided.area) area += a;
  EXPECT_NEAR(area, 0.5 + std::sqrt(2.0), 1e-12);

  Scene separate = make_scene({fan[0], fan[1]});
  separate.surfaces.push_back({.name = "partition", .material = 0, .two_sided = false});
  add_polygon(separate, fan[2], 1);
  EXPECT_GT(make_patches(separate, {.max_edge = 0.3}).size(), 3);
  Scene two_sided = make_scene(fan);
  two_sided.surfaces[0].two_sided = true;
  EXPECT_EQ(make_patches(two_sided).size(), 6);
}

TEST(Errors, TooManyPatches) {
  const std::string message = mesh_error(make_scene(box({1, 1, 1})), {.max_edge = 1e-6});
  expect_contains(message, "6e+12");
  expect_contains(message, "larger max edge");
  expect_contains(mesh_error(make_scene(box({1, 1, 1})), {.max_edge = 1e-12}), "larger max edge");
}

TEST(Progress, StopsWhenAsked) {
  std::stop_source stop;
  stop.request_stop();
  meshing::PatchOptions options;
  options.progress.stop = stop.get_token();
  EXPECT_THROW(make_patches(make_scene(box({1, 1, 1})), options), radiosity::Interrupted);
}

TEST(Invariance, SameInputSameAnswer) {
  const Scene scene = make_scene(l_room());
  const PatchMesh a = make_patches(scene, {.n_patches = 800});
  const PatchMesh b = make_patches(scene, {.n_patches = 800});
  EXPECT_EQ(a.vertices, b.vertices);
  EXPECT_EQ(a.corners, b.corners);
}

TEST(Invariance, ScaleAndPlace) {
  const Scene scene = make_scene(l_room());
  const PatchMesh reference = make_patches(scene, {.max_edge = 0.6});
  // Powers of two scale without rounding, so that the mesh is the same to the last bit.
  for (const double scale : {std::ldexp(1.0, -20), std::ldexp(1.0, 20)}) {
    Scene scaled = scene;
    for (Vec3& v : scaled.vertices) v *= scale;
    const PatchMesh mesh = make_patches(scaled, {.max_edge = 0.6 * scale});
    ASSERT_EQ(mesh.corners, reference.corners);
    for (Index i = 0; i < mesh.size(); ++i) {
      EXPECT_NEAR(mesh.area[i] / (scale * scale), reference.area[i], 1e-15);
    }
  }
  // Far away coordinates round to 2^-53 1e6 m or so; the room stays closed and as large.
  Scene moved = scene;
  for (Vec3& v : moved.vertices) v += Vec3(1e6, -2e6, 5e5);
  const PatchMesh mesh = make_patches(moved, {.max_edge = 0.6});
  for (const auto& [edge, n] : edge_uses(mesh)) EXPECT_EQ(n, 2);
  EXPECT_NEAR(total_area(mesh) / total_area(reference), 1, 1e-8);
  EXPECT_GT(quality(mesh).smallest_angle, 20 * kPi / 180);
}

}  // namespace
