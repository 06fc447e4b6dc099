#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/validation/cases/cases.h"
#include "apps/validation/cases/cie171_points.h"
#include "apps/validation/reference/built_scenes.h"
#include "meshing/patches/patches.h"
#include "radiosity/visibility/sky_light.h"

namespace apps::validation {
namespace {

using namespace radiosity;

constexpr int kSkyTypes = 16;
constexpr double kSunHeight = kPi / 3;
constexpr double kGroundReflectance = 0.3;
constexpr double kPercent = 100;
/// How the rooms are turned (radian) and moved once more, the sky with them.
constexpr double kSkyTurn = 2.1;
const Vec3 kSkyStep(-31.25, 4.5, 0.75);

/// The black room of 4 x 4 x 3 m with one face that has an opening, and that opening if it is
/// glazed: the face's rest is four trapezoids around it.
Scene room_with_opening(int face, const Polygon& opening, bool is_glazed) {
  Scene scene = empty_scene("CIE 171 room");
  std::vector<Polygon> faces = box_faces(Vec3::Zero(), Vec3(4, 4, 3), Facing::inwards);
  const Polygon whole = faces[face];
  faces.erase(faces.begin() + face);
  for (std::size_t k = 0; k < 4; ++k) {
    const std::size_t next = (k + 1) % 4;
    const Polygon side = {whole[k], whole[next], opening[next], opening[k]};
    if (vector_area(side).norm() > 0) faces.push_back(side);
  }
  add_surface(scene, "room", faces);
  if (is_glazed) {
    add_surface(scene, "glass", {opening});
    scene.materials.back().glazing =
        Glazing{.refractive_index = 1.52, .transmittance = Eigen::VectorXd::Constant(1, 0.96)};
  }
  return scene;
}

/// An opening in the ceiling (its corners in the order of the ceiling's), or in the wall y = 0.
Polygon roof_opening(double size) {
  const double low = 2 - size / 2;
  return parallelogram(Vec3(low, low, 3), Vec3(0, size, 0), Vec3(size, 0, 0));
}
Polygon wall_opening(double width, double sill, double height) {
  return parallelogram(Vec3(2 - width / 2, 0, sill), Vec3(0, 0, height), Vec3(width, 0, 0));
}

/// The sky of that type with the sun 60° high, at an angle from +y about z; E_h = 100 %.
Sky sky_of(int type, double angle) {
  Sky sky;
  sky.distribution = cie_sky(type);
  sky.towards_sun = Vec3(-std::sin(angle) * std::cos(kSunHeight),
                         std::cos(angle) * std::cos(kSunHeight), std::sin(kSunHeight));
  sky.zenith_radiance = Eigen::VectorXd::Constant(1, kPercent / horizontal_ratio(sky));
  sky.ground_reflectance = Eigen::VectorXd::Constant(1, kGroundReflectance);
  return sky;
}

enum class Part { sky, ground, both };

/// What points get of the sky, of the ground or of both, %.
std::vector<double> daylight(const SkyLight& light, const std::vector<RoomPoint>& points,
                             Part part) {
  std::vector<double> values;
  for (const RoomPoint& point : points) {
    const SkyIrradiance there = light.at(point.position, point.normal);
    values.push_back((part == Part::ground ? 0 : there.sky[0]) +
                     (part == Part::sky ? 0 : there.ground[0]));
  }
  return values;
}

/// How far all skies and rows of points are off, and how far they move with the room.
struct Worst {
  double off = 0;
  double moved = 0;
};

struct Row {
  std::string name;
  std::vector<RoomPoint> points;
  Part part = Part::sky;
  std::vector<std::string> keys = {};  // of the exact values
};

/// `sun` is the angle from +y about z at which the sun stands.
void compare_rows(Scene scene, int type, double sun, const std::vector<Row>& rows,
                  const Context& context, Worst& worst, Table& table) {
  scene.sky = sky_of(type, sun);
  Scene turned = scene;
  const Eigen::AngleAxisd turn(kSkyTurn, Vec3::UnitZ());
  for (Vec3& vertex : turned.vertices) vertex = turn * vertex + kSkyStep;
  turned.sky = sky_of(type, sun + kSkyTurn);
  const PatchMesh mesh = meshing::make_patches(scene, {.max_edge = 2});
  const PatchMesh turned_mesh = meshing::make_patches(turned, {.max_edge = 0.9});
  const SkyLight light(scene, mesh);
  const SkyLight turned_light(turned, turned_mesh);
  for (const Row& row : rows) {
    const std::vector<double> exact = exact_values(context.data, row.keys);
    const std::vector<double> computed = daylight(light, row.points, row.part);
    const std::vector<double> again =
        daylight(turned_light, moved(row.points, kSkyTurn, kSkyStep), row.part);
    double off = exact.size() == computed.size() ? 0 : NAN;
    for (std::size_t k = 0; k < exact.size() && k < computed.size(); ++k) {
      off = std::max(off, std::abs(computed[k] - exact[k]));
      worst.moved = std::max(worst.moved, std::abs(again[k] - computed[k]));
    }
    worst.off = std::max(worst.off, off);
    table.rows.push_back({fmt::format("{}, sky {}", row.name, type),
                          fmt::format("{:.4f}", computed.front()),
                          fmt::format("{:.4f}", computed.back()), fmt::format("{:.1e}", off)});
  }
}

void add_checks(CaseResult& result, const std::string& name, const Worst& worst) {
  constexpr double kHalfADigit = 5e-5;  // of values with 4 decimals
  constexpr double kQuadrature = 1e-4;  // %, 1e-6 of 100 %
  result.checks.push_back(
      {name + ", 16 skies: most that a point is off", worst.off, kHalfADigit + kQuadrature,
       "Half a unit of the last digit of our own exact values, and the quadrature over the sky, "
       "which is asked to leave 1e-6 of E_h at most.",
       "%"});
  result.checks.push_back(
      {name + ": turned with the sky, moved and divided otherwise", worst.moved, 2 * kQuadrature,
       "Twice what the quadrature may leave, over other parts of the sky.", "%"});
}

void check_roof(CaseResult& result, Table& table, double size, bool is_glazed,
                const Context& context) {
  const std::string name = fmt::format("{0:g}x{0:g}{1}", size, is_glazed ? " glazed" : "");
  const Scene scene = room_with_opening(1, roof_opening(size), is_glazed);
  Worst worst;
  for (int type = 1; type <= kSkyTypes; ++type) {
    const std::string sky = std::to_string(type);
    compare_rows(
        scene, type, 0,
        {{name + " A-F",
          wall_points(0, true, 2.75, 6),
          Part::sky,
          {"5.9 and 5.10", sky, name, "A-F"}},
         {name + " G-N", level_points(0, true, 8), Part::sky, {"5.9 and 5.10", sky, name, "G-N"}}},
        context, worst, table);
  }
  add_checks(result, (is_glazed ? "5.10 roof " : "5.9 roof ") + name, worst);
}

/// G is furthest from the facade.
std::vector<RoomPoint> from_far(std::vector<RoomPoint> points) {
  std::reverse(points.begin(), points.end());
  return points;
}

void check_facade(CaseResult& result, Table& table, const std::string& name, const Polygon& opening,
                  const Context& context) {
  const Scene scene = room_with_opening(4, opening, false);
  Worst worst;
  for (int type = 1; type <= kSkyTypes; ++type) {
    const std::string sky = std::to_string(type);
    compare_rows(scene, type, kPi,
                 {{name + " wall A-F, sky and ground",
                   wall_points(4, false, 2.75, 6),
                   Part::both,
                   {"5.11", sky, name, "wall A-F SC+ERC"}},
                  {name + " floor G-N, sky",
                   from_far(level_points(0, true, 8)),
                   Part::sky,
                   {"5.11", sky, name, "floor G-N SC"}},
                  {name + " ceiling G'-N', ground",
                   from_far(level_points(3, false, 8)),
                   Part::ground,
                   {"5.11", sky, name, "ceiling G'-N' ERC"}}},
                 context, worst, table);
  }
  add_checks(result, "5.11 facade " + name, worst);
}

/// E_h / L_z of the standard skies with the sun 60° high.
void check_horizontal(CaseResult& result, const Context& context) {
  double worst = 0;
  for (int type = 1; type <= kSkyTypes; ++type) {
    const double exact =
        exact_values(context.data, {"5.9 and 5.10", std::to_string(type), "Eh_over_Lz"}).front();
    worst = std::max(worst, std::abs(horizontal_ratio(sky_of(type, 0.3)) / exact - 1));
  }
  result.checks.push_back({"E_h / L_z of the 16 skies, relative", worst, 1e-6,
                           "What is promised; the quadrature is asked for 1e-8."});
}

}  // namespace

CaseResult run_cie171_sky(const Context& context) {
  CaseResult result{
      .compared =
          "CIE 171:2006, test cases of daylight: 5.9 (sky component below a roof opening of 1 x 1 "
          "and 4 x 4 m), 5.10 (the same, glazed) and 5.11 (facade openings of 2 x 1 and 4 x 3 m, "
          "with the ground), of the 16 standard skies (ISO 15469) with the sun 60° high opposite "
          "the wall A-F; % of E_h.",
      .reference =
          "Own exact values, integrated over the opening: tests/data/cie171-exact.json. Glass: "
          "Fresnel's share through both faces at n = 1.52, all reflections counted, times 0.96."};
  Table table{"First and last point of each row, %, and the most that a point is off",
              {"", "first", "last", "off"},
              {}};
  check_horizontal(result, context);
  for (const double size : {1., 4.}) {
    for (const bool is_glazed : {false, true}) {
      check_roof(result, table, size, is_glazed, context);
    }
  }
  check_facade(result, table, "2x1", wall_opening(2, 1, 1), context);
  check_facade(result, table, "4x3", wall_opening(4, 0, 3), context);
  result.notes.emplace_back(
      "The report's tables have errors of their own. 5.9 with 4 x 4 m, point A: 37.84, 46.74 and "
      "39.28 % of the skies 1, 5 and 16, where exact are 35.82, 45.12 and 37.36 (a uniform sky is "
      "a closed form), so that programs seem to miss that point by 5 %; sky 3 has its columns A-F "
      "in reverse; sky 13, G: 42.07 for 47.01. 5.11 with 4 x 3 m, N: 45.29 for 44.49. Elsewhere "
      "they agree with exact values within 0.33 %.");
  result.notes.emplace_back(
      "5.12 to 5.14 (glazed facades, an overhang, a facing wall) are in the case cie-171-facade, "
      "against own exact values.");
  result.figures.emplace_back(table);
  return result;
}

}  // namespace apps::validation
