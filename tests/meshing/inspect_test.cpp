#include "meshing/inspect/inspect.h"
#include "tests/support/messages.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace {

using meshing::Finding;
using meshing::inspect;
using meshing::Inspection;
using radiosity::Index;
using radiosity::Scene;
using radiosity::Vec3;
using radiosity::test::expect_contains;
using Kind = Finding::Kind;
using Severity = Finding::Severity;
using Polygon = std::vector<Vec3>;

constexpr int kWhite = 0;
constexpr int kLamp = 1;

Scene empty_scene() {
  Scene scene;
  scene.bands.kind = radiosity::Bands::Kind::grey;
  scene.materials.resize(2);
  scene.materials[kWhite].name = "white";
  scene.materials[kLamp].name = "lamp";
  scene.materials[kLamp].emission.kind = radiosity::Emission::Kind::radiance;
  scene.materials[kLamp].emission.value = Eigen::VectorXd::Constant(1, 1.0);
  return scene;
}

void add(Scene& scene, const Polygon& polygon) {
  std::vector<std::int32_t> corners;
  for (const Vec3& p : polygon) {
    corners.push_back(static_cast<std::int32_t>(scene.vertices.size()));
    scene.vertices.push_back(p);
  }
  scene.add_polygon(corners, static_cast<std::int32_t>(scene.surfaces.size()) - 1);
}

void add_surface(Scene& scene, const std::string& name, int material,
                 const std::vector<Polygon>& polygons) {
  scene.surfaces.push_back({.name = name, .material = material, .two_sided = false});
  for (const Polygon& p : polygons) add(scene, p);
}

Polygon reversed(Polygon polygon) {
  std::reverse(polygon.begin(), polygon.end());
  return polygon;
}

std::vector<Polygon> reversed(std::vector<Polygon> polygons) {
  for (Polygon& p : polygons) p = reversed(p);
  return polygons;
}

/// Six quads from corner `low` to corner `high`, normals inwards.
std::vector<Polygon> box(const Vec3& low, const Vec3& high) {
  const auto at = [&](int x, int y, int z) {
    return Vec3((x != 0 ? high : low).x(), (y != 0 ? high : low).y(), (z != 0 ? high : low).z());
  };
  return {{at(0, 0, 0), at(1, 0, 0), at(1, 1, 0), at(0, 1, 0)},
          {at(0, 0, 1), at(0, 1, 1), at(1, 1, 1), at(1, 0, 1)},
          {at(0, 0, 0), at(0, 0, 1), at(1, 0, 1), at(1, 0, 0)},
          {at(0, 1, 0), at(1, 1, 0), at(1, 1, 1), at(0, 1, 1)},
          {at(0, 0, 0), at(0, 1, 0), at(0, 1, 1), at(0, 0, 1)},
          {at(1, 0, 0), at(1, 0, 1), at(1, 1, 1), at(1, 1, 0)}};
}

std::vector<Polygon> unit_room() { return box({0, 0, 0}, {1, 1, 1}); }

/// Facing down, at height z.
Polygon lamp(double z) { return {{0.4, 0.4, z}, {0.4, 0.6, z}, {0.6, 0.6, z}, {0.6, 0.4, z}}; }

Scene clean_scene() {
  Scene scene = empty_scene();
  add_surface(scene, "room", kWhite, unit_room());
  add_surface(scene, "lamp", kLamp, {lamp(0.9)});
  return scene;
}

Scene one_surface(const std::vector<Polygon>& polygons) {
  Scene scene = empty_scene();
  add_surface(scene, "wall", kWhite, polygons);
  return scene;
}

/// The one finding of this kind; fails if there is none or another one.
Finding only(const Inspection& inspection, Kind kind) {
  std::vector<Finding> found;
  for (const Finding& f : inspection.findings) {
    if (f.kind == kind) found.push_back(f);
  }
  EXPECT_EQ(found.size(), 1U) << meshing::kind_name(kind);
  return found.empty() ? Finding{} : found.front();
}

std::string all_messages(const Inspection& inspection) {
  std::string text;
  for (const Finding& f : inspection.findings) text += f.message + "\n";
  return text;
}

TEST(Inspect, CleanSceneGivesNoFindings) {
  const Inspection result = inspect(clean_scene());
  EXPECT_TRUE(result.findings.empty()) << all_messages(result);
  EXPECT_EQ(result.n_vertices, 28);
  EXPECT_EQ(result.n_polygons, 7);
  EXPECT_EQ(result.n_quads, 7);
  EXPECT_EQ(result.n_triangles, 0);
  EXPECT_EQ(result.n_other, 0);
  EXPECT_NEAR(result.area, 6.04, 1e-14);
  ASSERT_EQ(result.surface_area.size(), 2U);
  EXPECT_NEAR(result.surface_area[0], 6, 1e-14);
  EXPECT_NEAR(result.surface_area[1], 0.04, 1e-15);
  EXPECT_EQ(result.surface_polygons, (std::vector<long>{6, 1}));
  EXPECT_EQ(result.bounds.min(), Vec3(0, 0, 0));
  EXPECT_EQ(result.bounds.max(), Vec3(1, 1, 1));
  EXPECT_FALSE(result.closed) << "the lamp hangs in the room with edges of its own";
  EXPECT_EQ(result.n_boundary_edges, 4);
}

TEST(Inspect, ClosedMeansEveryEdgeIsShared) {
  EXPECT_TRUE(inspect(one_surface(unit_room())).closed);
  std::vector<Polygon> open = unit_room();
  open.pop_back();
  EXPECT_FALSE(inspect(one_surface(open)).closed);
  EXPECT_EQ(inspect(one_surface(open)).n_boundary_edges, 4);
  // A two-sided panel in the room does not open it.
  Scene panel = clean_scene();
  panel.surfaces[1].two_sided = true;
  EXPECT_TRUE(inspect(panel).closed);
  EXPECT_EQ(inspect(panel).n_boundary_edges, 0);
  EXPECT_FALSE(inspect(empty_scene()).closed);
}

TEST(Inspect, EdgesMeetWithinThePrecision) {
  // A room whose walls went through other arithmetic than its floor and ceiling.
  const auto with_walls_off_by = [](double off) {
    std::vector<Polygon> room = unit_room();
    for (std::size_t k = 2; k < room.size(); ++k) {
      for (Vec3& p : room[k]) p += off * Vec3(1, k % 2 == 0 ? -1 : 1, 1);
    }
    return one_surface(room);
  };
  for (const double off : {1e-16, 1e-12}) {
    const Inspection result = inspect(with_walls_off_by(off));
    EXPECT_TRUE(result.closed);
    EXPECT_EQ(result.n_boundary_edges, 0);
    EXPECT_TRUE(result.findings.empty()) << all_messages(result);
  }
  Scene rounded = with_walls_off_by(1e-6);
  EXPECT_FALSE(inspect(rounded).closed);
  rounded.precision = 1e-6;
  EXPECT_TRUE(inspect(rounded).closed);
  EXPECT_TRUE(inspect(rounded).findings.empty()) << all_messages(inspect(rounded));
}

TEST(Inspect, EveryKindHasItsOwnName) {
  std::set<std::string_view> names;
  for (int k = 0; k <= static_cast<int>(Kind::suspicious_unit); ++k) {
    names.insert(meshing::kind_name(static_cast<Kind>(k)));
  }
  EXPECT_EQ(names.size(), 9U);
  EXPECT_EQ(meshing::kind_name(Kind::coplanar_overlap), "coplanar-overlap");
}

TEST(Inspect, DegeneratePolygons) {
  const Inspection result = inspect(one_surface({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                                                 {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}},
                                                 {{3, 3, 3}, {3, 3, 3}, {3, 3, 3}},
                                                 {{0, 0, 2}, {1, 1, 2}, {1, 0, 2}, {0, 1, 2}}}));
  const Finding finding = only(result, Kind::degenerate_polygon);
  EXPECT_EQ(finding.severity, Severity::serious);
  EXPECT_EQ(finding.count, 3);
  EXPECT_EQ(finding.polygon, 1);
  EXPECT_EQ(finding.surface, "wall");
  expect_contains(finding.message, "polygon 1");
  expect_contains(finding.message, "no area");

  const Inspection repeated = inspect(one_surface({{{0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {0, 1, 0}}}));
  EXPECT_EQ(only(repeated, Kind::degenerate_polygon).severity, Severity::note);
}

TEST(Inspect, DuplicatePolygons) {
  const Polygon a{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  Polygon turned = a;
  std::rotate(turned.begin(), turned.begin() + 2, turned.end());
  const Finding same = only(inspect(one_surface({a, turned})), Kind::duplicate_polygon);
  EXPECT_EQ(same.severity, Severity::serious);
  EXPECT_EQ(same.polygon, 1);
  expect_contains(same.message, "same as surface 'wall', polygon 0");

  const Inspection back = inspect(one_surface({a, reversed(turned)}));
  const Finding finding = only(back, Kind::duplicate_polygon);
  EXPECT_EQ(finding.severity, Severity::note);
  expect_contains(finding.message, "back-to-back");
  EXPECT_EQ(back.findings.size(), 1U) << all_messages(back);
}

TEST(Inspect, LightInThePlaneOfTheCeiling) {
  Scene scene = empty_scene();
  add_surface(scene, "room", kWhite, unit_room());
  add_surface(scene, "lamp", kLamp, {lamp(1.0)});
  const Inspection result = inspect(scene);
  const Finding finding = only(result, Kind::coplanar_overlap);
  EXPECT_EQ(finding.severity, Severity::serious);
  EXPECT_EQ(finding.surface, "lamp");
  EXPECT_EQ(finding.polygon, 6);
  expect_contains(finding.message, "surface 'room', polygon 1");
  EXPECT_EQ(result.findings.size(), 1U) << all_messages(result);
}

TEST(Inspect, LightInAHoleOfTheCeilingIsFine) {
  Scene scene = empty_scene();
  std::vector<Polygon> room = unit_room();
  // The ceiling as one polygon with a slit to the hole.
  room[1] = {{0, 0, 1},     {0, 1, 1},     {1, 1, 1},     {1, 0, 1},     {0, 0, 1},
             {0.4, 0.4, 1}, {0.6, 0.4, 1}, {0.6, 0.6, 1}, {0.4, 0.6, 1}, {0.4, 0.4, 1}};
  add_surface(scene, "room", kWhite, room);
  add_surface(scene, "lamp", kLamp, {lamp(1.0)});
  const Inspection result = inspect(scene);
  EXPECT_TRUE(result.findings.empty()) << all_messages(result);
}

TEST(Inspect, BoxStandingOnTheFloorIsANote) {
  Scene scene = clean_scene();
  add_surface(scene, "block", kWhite, reversed(box({0.2, 0.2, 0}, {0.5, 0.5, 0.3})));
  const Inspection result = inspect(scene);
  const Finding finding = only(result, Kind::coplanar_overlap);
  EXPECT_EQ(finding.severity, Severity::note);
  EXPECT_EQ(finding.surface, "block");
  EXPECT_EQ(result.findings.size(), 1U) << all_messages(result);
}

TEST(Inspect, OverlapOfManyPolygonsIsCountedOnce) {
  // A finely divided floor and one rug in its plane that covers 4 x 4 of its quads exactly.
  constexpr int kCells = 30;
  Scene scene = empty_scene();
  std::vector<Polygon> floor;
  for (int j = 0; j < kCells; ++j) {
    for (int i = 0; i < kCells; ++i) {
      const double x = 0.1 * i;
      const double y = 0.1 * j;
      floor.push_back({{x, y, 0},
                       {0.1 * (i + 1), y, 0},
                       {0.1 * (i + 1), 0.1 * (j + 1), 0},
                       {x, 0.1 * (j + 1), 0}});
    }
  }
  add_surface(scene, "floor", kWhite, floor);
  const Inspection clean = inspect(scene);
  EXPECT_TRUE(clean.findings.empty()) << all_messages(clean);
  add_surface(scene, "rug", kWhite, {{{1, 1, 0}, {1.4, 1, 0}, {1.4, 1.4, 0}, {1, 1.4, 0}}});
  const Finding finding = only(inspect(scene), Kind::coplanar_overlap);
  EXPECT_EQ(finding.severity, Severity::serious);
  EXPECT_EQ(finding.surface, "rug");
  EXPECT_EQ(finding.count, 16);
}

TEST(Inspect, TwoSidedPolygonsOverlapEitherWay) {
  Scene scene = clean_scene();
  add_surface(scene, "picture", kWhite,
              {{{0.2, 0.2, 0}, {0.2, 0.4, 0}, {0.4, 0.4, 0}, {0.4, 0.2, 0}}});
  EXPECT_EQ(only(inspect(scene), Kind::coplanar_overlap).severity, Severity::note);
  EXPECT_FALSE(meshing::overlap_finding(scene));
  scene.surfaces.back().two_sided = true;
  EXPECT_EQ(only(inspect(scene), Kind::coplanar_overlap).severity, Severity::serious);
  EXPECT_TRUE(meshing::overlap_finding(scene));
}

TEST(Inspect, PrecisionTellsWhatLiesInOnePlane) {
  Scene scene = clean_scene();
  add_surface(scene, "rug", kWhite,
              {{{0.2, 0.2, 1e-5}, {0.4, 0.2, 1e-5}, {0.4, 0.4, 1e-5}, {0.2, 0.4, 1e-5}}});
  EXPECT_TRUE(inspect(scene).findings.empty()) << all_messages(inspect(scene));
  scene.precision = 5e-6;
  EXPECT_EQ(only(inspect(scene), Kind::coplanar_overlap).severity, Severity::serious);
}

TEST(Inspect, NonPlanarPolygonTellsTheWorst) {
  const Finding finding =
      only(inspect(one_surface({{{0, 0, 0}, {1, 0, 0}, {1, 1, 0.001}, {0, 1, 0}},
                                {{2, 0, 0}, {3, 0, 0}, {3, 1, 0.003}, {2, 1, 0}},
                                {{4, 0, 0}, {5, 0, 0}, {5, 1, 1e-9}, {4, 1, 0}}})),
           Kind::non_planar_polygon);
  EXPECT_EQ(finding.count, 2);
  EXPECT_EQ(finding.polygon, 1);
  EXPECT_EQ(finding.severity, Severity::note);
  expect_contains(finding.message, "0.003 m");
}

TEST(Inspect, NonManifoldEdge) {
  std::vector<Polygon> fan{{{0, 0, 0}, {0, 0, 1}, {1, 0, 1}},
                           {{0, 0, 0}, {0, 0, 1}, {-1, 1, 1}},
                           {{0, 0, 1}, {0, 0, 0}, {-1, -1, 1}}};
  const Finding finding = only(inspect(one_surface(fan)), Kind::non_manifold_edge);
  EXPECT_EQ(finding.severity, Severity::warning);
  expect_contains(finding.message, "3 polygons");

  // Of different surfaces it is a partition that meets a wall.
  Scene partition = one_surface({fan[0], fan[2]});
  add_surface(partition, "partition", kWhite, {fan[1]});
  for (const Finding& f : inspect(partition).findings) EXPECT_NE(f.kind, Kind::non_manifold_edge);
}

TEST(Inspect, NeighbourThatFacesTheOtherWay) {
  std::vector<Polygon> room = unit_room();
  room[3] = reversed(room[3]);
  const Finding finding = only(inspect(one_surface(room)), Kind::flipped_orientation);
  EXPECT_EQ(finding.count, 4) << "edges on which it disagrees";
  EXPECT_EQ(finding.severity, Severity::warning);
  EXPECT_EQ(finding.surface, "wall");
}

TEST(Inspect, RoomInsideOut) {
  Scene scene = empty_scene();
  add_surface(scene, "room", kWhite, reversed(unit_room()));
  EXPECT_TRUE(inspect(scene).findings.empty()) << "may be a box seen from outside";
  Scene lit = scene;
  add_surface(lit, "lamp", kLamp, {lamp(0.9)});
  const Finding finding = only(inspect(lit), Kind::flipped_orientation);
  EXPECT_EQ(finding.severity, Severity::serious);
  EXPECT_EQ(finding.surface, "room");
  expect_contains(finding.message, "outwards");

  Scene with_camera = scene;
  with_camera.camera.emplace().position = Vec3(0.3, 0.4, 0.5);
  EXPECT_EQ(only(inspect(with_camera), Kind::flipped_orientation).surface, "room");
  with_camera.camera->position = Vec3(0.3, 0.4, 3);
  EXPECT_TRUE(inspect(with_camera).findings.empty());

  // A room whose ceiling is the lamp.
  Scene shining = scene;
  shining.surfaces.push_back({.name = "ceiling", .material = kLamp, .two_sided = false});
  shining.polygon_surface[1] = 1;
  EXPECT_EQ(only(inspect(shining), Kind::flipped_orientation).surface, "room");
}

TEST(Inspect, BlockInsideOut) {
  Scene scene = clean_scene();
  add_surface(scene, "block", kWhite, box({0.2, 0.2, 0.1}, {0.5, 0.5, 0.3}));
  const Finding finding = only(inspect(scene), Kind::flipped_orientation);
  EXPECT_EQ(finding.severity, Severity::warning);
  EXPECT_EQ(finding.surface, "block");
  expect_contains(finding.message, "inwards");
}

TEST(Inspect, LightThatFacesTheCeiling) {
  Scene scene = empty_scene();
  add_surface(scene, "room", kWhite, unit_room());
  add_surface(scene, "lamp", kLamp, {reversed(lamp(0.999))});
  const Finding finding = only(inspect(scene), Kind::flipped_orientation);
  EXPECT_EQ(finding.surface, "lamp");
  expect_contains(finding.message, "surface 'room', polygon 1");
  expect_contains(finding.message, "0.001 m");
}

TEST(Inspect, TJunction) {
  const Inspection result = inspect(one_surface({{{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}},
                                                 {{0, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}},
                                                 {{1, 1, 0}, {2, 1, 0}, {2, 2, 0}, {1, 2, 0}}}));
  const Finding finding = only(result, Kind::t_junction);
  EXPECT_EQ(finding.severity, Severity::note);
  EXPECT_EQ(finding.count, 1);
  EXPECT_EQ(finding.polygon, 0);
  expect_contains(finding.message, "(1, 1, 0)");
  EXPECT_EQ(result.findings.size(), 1U) << all_messages(result);
}

TEST(Inspect, Gap) {
  const auto apart = [](double gap) {
    return one_surface({{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}},
                        {{1 + gap, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1 + gap, 1, 0}}});
  };
  const Finding finding = only(inspect(apart(1e-5)), Kind::gap);
  EXPECT_EQ(finding.severity, Severity::warning);
  EXPECT_EQ(finding.count, 2);
  expect_contains(finding.message, "1e-05 m");
  EXPECT_EQ(only(inspect(apart(1e-9)), Kind::gap).severity, Severity::note);
  EXPECT_TRUE(inspect(apart(0)).findings.empty());
  EXPECT_TRUE(inspect(apart(1e-15)).findings.empty());
  Scene rounded = apart(1e-5);
  rounded.precision = 5e-6;
  EXPECT_TRUE(inspect(rounded).findings.empty()) << all_messages(inspect(rounded));
  EXPECT_TRUE(inspect(apart(0.01)).findings.empty());

  // The middle of an edge passes a corner.
  const Inspection beside = inspect(one_surface({{{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}},
                                                 {{1, 1 + 1e-5, 0}, {1.5, 2, 0}, {0.5, 2, 0}}}));
  EXPECT_EQ(only(beside, Kind::gap).polygon, 0);
}

TEST(Inspect, SuspiciousUnit) {
  Scene millimetres = clean_scene();
  for (Vec3& v : millimetres.vertices) v *= 450;
  const Finding finding = only(inspect(millimetres), Kind::suspicious_unit);
  EXPECT_EQ(finding.severity, Severity::note);
  EXPECT_EQ(finding.polygon, -1);
  EXPECT_EQ(finding.surface, "");
  expect_contains(finding.message, "779.4 m across");
  expect_contains(finding.message, "--unit mm");
  Scene tiny = clean_scene();
  for (Vec3& v : tiny.vertices) v *= 1e-3;
  EXPECT_EQ(inspect(tiny).findings.size(), 1U) << all_messages(inspect(tiny));
}

TEST(Inspect, SeriousFindingsComeFirst) {
  Scene scene = empty_scene();
  add_surface(scene, "bent", kWhite, {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0.001}, {0, 1, 0}}});
  add_surface(scene, "needle", kWhite, {{{0, 0, 1}, {1, 1, 1}, {2, 2, 1}}});
  const Inspection result = inspect(scene);
  ASSERT_EQ(result.findings.size(), 2U) << all_messages(result);
  EXPECT_EQ(result.findings[0].kind, Kind::degenerate_polygon);
}

TEST(Inspect, NeverThrowsForBadGeometry) {
  Scene scene = empty_scene();
  scene.vertices = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  add_surface(scene, "odd", kWhite, {});
  for (const std::vector<std::int32_t>& corners : std::vector<std::vector<std::int32_t>>{
           {}, {0}, {0, 1}, {0, 0, 0}, {0, 1, 2}, {0, 3, 1, 4}, {0, 1, 0, 1}, {0, 3, 4, 1, 2}}) {
    scene.add_polygon(corners, 0);
  }
  const Inspection result = inspect(scene);
  EXPECT_EQ(only(result, Kind::degenerate_polygon).severity, Severity::serious);
  EXPECT_TRUE(inspect(Scene()).findings.empty());
}

}  // namespace
