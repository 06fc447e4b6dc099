// Scenes of View3D, and what is cut out of their bases.

#include "io/mesh/vs3_reader.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>

#include "io/base/flat_difference.h"
#include "tests/support/sample_files.h"
#include "tests/support/scratch_files.h"

namespace {

using radiosity::ConvexPolygon;
using radiosity::Index;
using radiosity::Scene;
using radiosity::Vec3;

class Vs3 : public ScratchFiles {};

Vec3 area_of(const Scene& scene, std::size_t surface) {
  Vec3 sum = Vec3::Zero();
  for (Index i = 0; i < scene.n_polygons(); ++i) {
    if (scene.polygon_surface[static_cast<std::size_t>(i)] != static_cast<int>(surface)) continue;
    std::vector<Vec3> points;
    for (const auto vertex : scene.polygon(i)) points.push_back(scene.vertices[vertex]);
    sum += radiosity::vector_area(points);
  }
  return sum;
}

std::vector<std::string> names_of(const Scene& scene) {
  std::vector<std::string> names;
  for (const auto& surface : scene.surfaces) names.push_back(surface.name);
  return names;
}

TEST_F(Vs3, ReadsVerticesPartsHolesAndCombinations) {
  for (const std::string& text :
       {kVs3, "\xef\xbb\xbf" + kVs3, std::string(kVs3).replace(kVs3.find('\n'), 1, "\r\n")}) {
    const Scene scene = read("a.vs3", text);
    EXPECT_EQ(scene.name, "a room / with a window");
    EXPECT_EQ(names_of(scene),
              (std::vector<std::string>{"floor", "part", "wall", "obstruction 6"}));
    EXPECT_LT((area_of(scene, 0) - Vec3(0, 0, 12 - 1 - 0.5)).norm(), 1e-14);
    EXPECT_LT((area_of(scene, 1) - Vec3(0, 0, 1)).norm(), 1e-14);
    EXPECT_NEAR(std::abs(area_of(scene, 2).y()), 8, 1e-14);
    EXPECT_EQ(scene.materials[scene.surfaces[0].material].reflectance[0], 1 - 0.9);
    EXPECT_EQ(scene.materials[scene.surfaces[3].material].reflectance[0], 0);
    EXPECT_FALSE(scene.closed.has_value());
    EXPECT_TRUE(scene.warnings.empty()) << scene.warnings.front();
  }
}

TEST_F(Vs3, ReadsPlanes) {
  const Scene scene = read("a.vs3", kVs3a);
  EXPECT_EQ(names_of(scene), (std::vector<std::string>{"south", "ceiling", "obstruction 3"}));
  // The wall at y = 0 looks to y, the ceiling down from z = 3, over x, y in [0, 1].
  EXPECT_LT((area_of(scene, 0) - Vec3(0, 9, 0)).norm(), 1e-14);
  EXPECT_LT((area_of(scene, 1) - Vec3(0, 0, -1)).norm(), 1e-14);
  EXPECT_EQ(scene.vertices[scene.polygon(1)[0]], Vec3(1, 0, 3));
}

TEST_F(Vs3, WarnsOfWhatIsReadOtherwise) {
  const Scene scene =
      read("a.vs3", "C row=2\n" + std::string(kVs3).replace(kVs3.find("0 4 0.7"), 7, "0 4 0.6"));
  ASSERT_EQ(scene.warnings.size(), 2U);
  EXPECT_CONTAINS(scene.warnings[0], "a.vs3: line 1: all rows and columns are computed");
  EXPECT_CONTAINS(scene.warnings[1], "surface 5 is combined with surface 4 of another emissivity");
}

TEST_F(Vs3, RefusesFaultsByTheirLine) {
  const std::string corners =
      "F 3\nV 1 0 0 0\nV 2 2 0 0\nV 3 2 2 0\nV 4 0 2 0\nV 5 1 1 1\nV 6 3 1 0\nV 7 1 1 0\n"
      "V 8 1 0 0\n";
  const std::string base = corners + "S 1 1 2 3 4 0 0 0.5 base\n";
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"F 2\n", "a.vs3:1: expected the geometry 3 or 3a, found"},
      {"S 1 1 2 3 0 0 0 1 a\n", "a.vs3:1: a surface before the geometry"},
      {"F 3\nV 2 0 0 0\n", "a.vs3:2: vertex 2 is out of sequence, expected 1"},
      {"F 3\nV 1 0 x 0\n", "a.vs3:2: expected a number for coordinate y, found \"x\""},
      {"F 3\nV 1 0 0\n", "a.vs3:2: line ends where coordinate z is expected"},
      {"F 3\nV 1 0 0 inf\n", "a.vs3:2: coordinate z is not finite"},
      {"F 3\n", "file ends without surfaces"},
      {"T only\n", "file ends without the geometry"},
      {"F 3\nX 1\n", "a.vs3:2: expected one of T, C, F, V, S, M, N, O, E, found \"X\""},
      {"C out=2\nF 3\n", "a.vs3:1: expected out=0 (text) or out=1 (binary)"},
      {"F 3\nC eps\n", "a.vs3:2: line ends where the value of \"eps\" is expected"},
      {corners + "S 1 1 2 9 0 0 0 1 a\n", "a.vs3:10: the surface uses vertex 9, but there are 8"},
      {corners + "S 1 1 2 3 4 0 0 1.5 a\n", "a.vs3:10: emissivity 1.5 is outside [0, 1]"},
      {corners + "S 1 1 2 3 4 0 0\n", "a.vs3:10: line ends where the emissivity is expected"},
      {base + "S 3 1 2 3 4 0 0 1 a\n", "a.vs3:11: surface 3 is out of sequence, expected 2"},
      {base + "M 2 1 2 7 0 1 0 1 a\n", "surface 2 must face its base 1, the other way"},
      {base + "M 2 7 2 1 0 1 0 1 a\nS 3 1 2 7 0 2 0 1 b\n",
       "a.vs3:12: surface 3 has the base 2, which is a null or masking surface"},
      {base + "M 2 7 2 1 0 1 1 1 a\n",
       "a.vs3:11: a masking surface (M) or null surface (N) cannot"},
      {base + "S 2 1 2 5 0 1 0 1 a\n", "a.vs3:11: surface 2 does not lie in the plane"},
      {base + "S 2 1 7 2 0 1 0 1 a\n", "a.vs3:11: surface 2 must face the same way as its base 1"},
      {base + "N 2 1 2 7 0 1 0 1 a\n", "surface 2 must face its base 1, the other way"},
      {base + "S 2 1 2 6 0 1 0 1 a\n", "a.vs3:11: surface 2 reaches beyond its base 1"},
      {base + "S 2 1 2 3 4 1 0 1 a\n", "a.vs3:10: surface 1 is wholly covered"},
      {base + "S 2 1 2 7 0 2 0 1 a\n", "surface 2 has the base 2, expected an earlier surface"},
      {base + "S 2 1 2 7 0 7 0 1 a\n", "surface 2 has the base 7, but there are 2"},
      {base + "N 2 7 2 1 0 0 0 1 a\n", "surface 2 covers a part of its base, but has none"},
      {base + "S 2 1 2 7 0 0 2 1 a\n", "a.vs3:11: combined with surface 2, expected an earlier"},
      {base + "S 2 1 2 5 0 0 1 1 a\nS 3 1 2 5 0 0 2 1 a\n", "which is itself combined with 1"},
      {base + "O 2 1 2 5 0\nS 3 1 2 5 0 0 0 1 a\n", "obstructions (O) must come after all others"},
      {"F 3a\nS 1 Z 0 0 1 a\n", "a.vs3:2: expected the shape R, T or Q, found \"z\""},
      {"F 3a\nS 1 R 0 0 1 a\n0 0 0 0 0 1\n", "file ends where the height is expected"},
  };
  for (const auto& [text, message] : cases) EXPECT_CONTAINS(error_of("a.vs3", text), message);
}

double area(const ConvexPolygon& polygon) {
  return radiosity::vector_area(polygon.points()).norm();
}

/// A regular polygon in a plane that is turned and moved.
ConvexPolygon ring(const Eigen::Isometry3d& place, const Eigen::Vector2d& middle, double radius,
                   int n, double turn) {
  ConvexPolygon result;
  for (int k = 0; k < n; ++k) {
    const double angle = turn + 2 * M_PI * k / n;
    result.push_back(place * Vec3(middle.x() + radius * std::cos(angle),
                                  middle.y() + radius * std::sin(angle), 0));
  }
  return result;
}

TEST(FlatDifference, HasTheAreaThatIsLeft) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> share(0, 1);
  for (int trial = 0; trial < 100; ++trial) {
    const double size = std::pow(10, 4 * share(random) - 2);
    const Vec3 axis = Vec3(share(random), share(random), share(random) + 0.1).normalized();
    Eigen::Isometry3d place = Eigen::Isometry3d::Identity();
    place.translate(10 * size * Vec3(share(random), share(random), share(random)));
    place.rotate(Eigen::AngleAxisd(7 * share(random), axis));
    const ConvexPolygon whole = ring(place, {0, 0}, size, 4, 7 * share(random));
    const Vec3 normal = radiosity::vector_area(whole.points()).normalized();
    // Holes of radius 0.2 about the middle and, clear of it and of each other, about others.
    std::vector<ConvexPolygon> holes;
    double expected = area(whole);
    for (int k = 0; k < 5; ++k) {
      const double angle = 2 * M_PI * k / 5;
      const Eigen::Vector2d middle =
          0.48 * size * Eigen::Vector2d(std::cos(angle), std::sin(angle));
      holes.push_back(ring(place, middle, 0.2 * size * share(random) + 0.01 * size, 3 + trial % 2,
                           7 * share(random)));
      expected -= area(holes.back());
    }
    holes.push_back(ring(place, {5 * size, 0}, size, 4, 0));  // beside it
    double sum = 0;
    for (const ConvexPolygon& piece : io::flat_difference(whole, holes, normal, 1e-9 * size)) {
      sum += radiosity::vector_area(piece.points()).dot(normal);
    }
    // Some 25 cuts of up to 2 sizes may each lose a strip of the thickness.
    EXPECT_NEAR(sum, expected, 1e-7 * size * size) << trial;
  }
}

/// Lines of a file of rectangles in one plane.
struct Vs3Writer {
  Eigen::Isometry3d place;
  std::string vertices = {};
  std::string surfaces = {};
  int n_vertices = 0;
  int n_surfaces = 0;

  /// Returns its number.
  int add(char kind, const Eigen::Vector2d& low, const Eigen::Vector2d& size, int base,
          int combined, const std::string& name) {
    const bool is_turned = kind == 'N';
    std::string corners;
    for (int k = 0; k < 4; ++k) {
      const int at = is_turned ? 3 - k : k;
      const Vec3 x = place * Vec3(low.x() + (at == 1 || at == 2 ? size.x() : 0),
                                  low.y() + (at >= 2 ? size.y() : 0), 0);
      ++n_vertices;
      vertices += fmt::format("V {} {} {} {}\n", n_vertices, x.x(), x.y(), x.z());
      corners += fmt::format(" {}", n_vertices);
    }
    ++n_surfaces;
    surfaces +=
        fmt::format("{} {}{} {} {} 0.5 {}\n", kind, n_surfaces, corners, base, combined, name);
    return n_surfaces;
  }
};

// Bases turned and placed anywhere, with random parts and holes in cells of a grid: what is left of
// the base has the area that is left, each of its points once.
TEST_F(Vs3, RandomFilesKeepTheirAreas) {
  constexpr unsigned kVs3Seed = 20261127;
  SCOPED_TRACE("seed " + std::to_string(kVs3Seed));
  std::mt19937_64 random(kVs3Seed);
  std::uniform_real_distribution<double> share(0, 1);
  for (int trial = 0; trial < 40; ++trial) {
    const double scale = std::pow(10, 4 * share(random) - 2);
    Vs3Writer writer{Eigen::Isometry3d::Identity()};
    const Vec3 axis = Vec3(share(random), share(random), share(random) + 0.1).normalized();
    writer.place.translate(5 * scale * Vec3(share(random), share(random), share(random)));
    writer.place.rotate(Eigen::AngleAxisd(7 * share(random), axis));
    const Eigen::Vector2d side = scale * Eigen::Vector2d(1 + share(random), 1 + share(random));
    const int base = writer.add('S', {0, 0}, side, 0, 0, "base");
    double left = side.prod();
    double in_parts = 0;
    int first_part = 0;
    for (int cell = 0; cell < 6; ++cell) {
      if (share(random) < 0.3) continue;
      const Eigen::Vector2d room(side.x() / 3, side.y() / 2);
      const Eigen::Vector2d corner(room.x() * (cell % 3), room.y() * (cell / 3));
      const Eigen::Vector2d size =
          room.cwiseProduct(Eigen::Vector2d(0.1 + 0.8 * share(random), 0.1 + 0.8 * share(random)));
      const Eigen::Vector2d low =
          corner + (room - size).cwiseProduct(Eigen::Vector2d(share(random), share(random)));
      const bool is_hole = share(random) < 0.4;
      const int part = writer.add(is_hole ? 'N' : 'S', low, size, base, is_hole ? 0 : first_part,
                                  fmt::format("part{}", cell));
      left -= size.prod();
      if (is_hole) continue;
      in_parts += size.prod();
      if (first_part == 0) first_part = part;
    }
    const Scene scene =
        read("r.vs3", "T random\nF 3\n" + writer.vertices + writer.surfaces + "E\n");
    // Cuts may each lose a strip of 1e-5 of the base's size.
    const double exact = 1e-4 * side.prod();
    const Vec3 normal = writer.place.linear().col(2);
    EXPECT_NEAR(area_of(scene, 0).dot(normal), left, exact) << trial;
    ASSERT_EQ(scene.surfaces.size(), first_part > 0 ? 2U : 1U) << trial;
    if (first_part > 0) {
      EXPECT_NEAR(area_of(scene, 1).dot(normal), in_parts, exact) << trial;
    }
    EXPECT_EQ(scene.surfaces[0].name, "base");
  }
}

}  // namespace
