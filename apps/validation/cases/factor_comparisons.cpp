#include "apps/validation/cases/factor_comparisons.h"
#include "apps/validation/cases/asked.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "apps/validation/cases/curved_factors.h"
#include "apps/validation/reference/built_scenes.h"
#include "apps/validation/reference/known_factors.h"
#include "apps/validation/reference/own_light.h"
#include "radiosity/assembly/transport_options.h"
#include "radiosity/base/error.h"
#include "radiosity/operator/surface_factors.h"
#include "radiosity/polygon/exchange_area.h"
#include "radiosity/polygon/point_to_polygon.h"

namespace apps::validation {
namespace {

using namespace radiosity;

using Comparisons = std::vector<FactorComparison>;
using Compare = Comparisons (*)(const KnownFactor&, const Context&);

Comparisons both_directions(const std::string& name, const Polygon& a, const Polygon& b,
                            double exchange) {
  return {{name, FactorKind::polygons, exchange_area(a, b), exchange},
          {name + ", from the other", FactorKind::polygons, exchange_area(b, a), exchange}};
}

/// Pairs of polygons; one entry gives a pentagon and a square in words only.
Comparisons compare_polygons(const KnownFactor& known, const Context& /*context*/) {
  if (!known.polygon1.empty()) {
    return both_directions(known.name, known.polygon1, known.polygon2, known.exchange_area);
  }
  const Polygon pentagon{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0.5, 2, 0}, {0, 1, 0}};
  const Polygon square{{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}};
  constexpr double kPentagonArea = 1.5;
  return both_directions(known.name, pentagon, square, kPentagonArea * known.value("F12"));
}

FactorComparison pair(const KnownFactor& known, const std::string& what, const Polygon& from,
                      const Polygon& to, double expected) {
  return {fmt::format("{}: {}", known.name, what), FactorKind::polygons,
          exchange_area(from, to) / vector_area(from).norm(), expected};
}

Comparisons compare_octahedron(const KnownFactor& known) {
  const Vec3 x = Vec3::UnitX();
  const Vec3 y = Vec3::UnitY();
  const Vec3 z = Vec3::UnitZ();
  const Polygon face{x, z, y};  // seen from the centre
  return {pair(known, "F_adjacent_edge", face, {y, z, -x}, known.value("F_adjacent_edge")),
          pair(known, "F_sharing_vertex", face, {-x, z, -y}, known.value("F_sharing_vertex")),
          pair(known, "F_opposite", face, {-x, -y, -z}, known.value("F_opposite"))};
}

/// A prism with n sides that are unit squares.
Comparisons compare_prism(const KnownFactor& known) {
  const auto n = static_cast<int>(known.params.at("n"));
  const double radius = 0.5 / std::sin(kPi / n);
  const std::vector<Polygon> faces = prism_inside(regular_polygon(n, radius, 0, true), 1);
  Comparisons list = {pair(known, "F_end_end", faces[0], faces[1], known.value("F_end_end")),
                      pair(known, "F_side_end", faces[2], faces[0], known.value("F_side_end"))};
  const std::vector<double>& sides = known.values.at("F_side_side_by_separation");
  for (std::size_t k = 0; k < sides.size(); ++k) {
    list.push_back(
        pair(known, fmt::format("F_side_side, {} apart", k + 1), faces[2], faces[3 + k], sides[k]));
  }
  return list;
}

Comparisons compare_polyhedron(const KnownFactor& known, const Context& /*context*/) {
  if (known.params.contains("n")) return compare_prism(known);
  if (known.values.contains("F_adjacent_edge")) return compare_octahedron(known);
  const std::vector<Polygon> faces = box_faces(Vec3::Zero(), Vec3::Ones(), Facing::inwards);
  return {pair(known, "F_opposite", faces[0], faces[1], known.value("F_opposite")),
          pair(known, "F_adjacent", faces[0], faces[2], known.value("F_adjacent"))};
}

Comparisons compare_point(const KnownFactor& known, const Context& /*context*/) {
  const double a = known.params.at("a");
  const double b = known.params.at("b");
  const double c = known.params.at("c");
  const Polygon rectangle =
      parallelogram(Vec3(0, 0, c), Vec3(0, b, 0), Vec3(a, 0, 0));  // faces down
  return {{known.name, FactorKind::point, point_to_polygon(Vec3::Zero(), Vec3::UnitZ(), rectangle),
           known.value("F_d1_2")}};
}

/// The scene as it is, its form factors without a correction.
study::Study assemble_raw(Scene scene, double tolerance, const Context& context) {
  return study::assemble(std::move(scene),
                         {.patches = {.as_is = true},
                          .tolerance = tolerance,
                          .closed = Closed::no,
                          .seed = context.seed},
                         {.progress = {.report = {}, .stop = context.progress.stop}});
}

Eigen::MatrixXd occluded_factors(Scene scene, const Context& context) {
  const study::Study assembly = assemble_raw(std::move(scene), kOccludedTolerance, context);
  return surface_form_factors(assembly.mesh, *assembly.transport);
}

FactorComparison occluded(const KnownFactor& known, const std::string& key, double computed) {
  return {fmt::format("{}: {}", known.name, key), FactorKind::occluded, computed, known.value(key)};
}

/// Unit squares about the z axis at z = 0 and 1, surfaces 0 and 1, with a screen between them.
Scene screened_squares(const Polygon& screen) {
  Scene scene = empty_scene("screen between squares");
  const Vec3 low(-0.5, -0.5, 0);
  add_surface(scene, "low", {parallelogram(low, Vec3::UnitX(), Vec3::UnitY())});
  add_surface(scene, "high", {parallelogram(low + Vec3::UnitZ(), Vec3::UnitY(), Vec3::UnitX())});
  add_surface(scene, "screen", {screen}, {.two_sided = true});
  return scene;
}

Comparisons compare_screen(const KnownFactor& known, const Context& context) {
  const double side = known.params.at("b");
  const Vec3 corner(known.params.at("ox") - side / 2, known.params.at("oy") - side / 2, 0.5);
  const Polygon screen = parallelogram(corner, side * Vec3::UnitX(), side * Vec3::UnitY());
  return {occluded(known, "F12", occluded_factors(screened_squares(screen), context)(0, 1))};
}

Comparisons compare_septum(const KnownFactor& known, const Context& context) {
  const Polygon septum = parallelogram(Vec3(0, -5, -5), 10 * Vec3::UnitY(), 10 * Vec3::UnitZ());
  return {occluded(known, "F12", occluded_factors(screened_squares(septum), context)(0, 1))};
}

Comparisons compare_nested_cubes(const KnownFactor& known, const Context& context) {
  const Vec3 half = Vec3::Constant(known.params.at("a") / 2);
  const Vec3 center = Vec3::Constant(0.5);
  const std::vector<Polygon> outer = box_faces(Vec3::Zero(), Vec3::Ones(), Facing::inwards);
  const std::vector<Polygon> inner = box_faces(center - half, center + half, Facing::outwards);
  Scene scene = empty_scene("nested cubes");
  for (const Polygon& face : outer) add_surface(scene, "outer", {face});
  for (const Polygon& face : inner) add_surface(scene, "inner", {face});
  const Eigen::MatrixXd factors = occluded_factors(std::move(scene), context);
  return {occluded(known, "F_inner_to_outer", factors.bottomLeftCorner(6, 6).sum() / 6),
          occluded(known, "F_outer_to_inner", factors.topRightCorner(6, 6).sum() / 6),
          occluded(known, "F_outer_to_outer", factors.topLeftCorner(6, 6).sum() / 6),
          occluded(known, "F_inner_face_to_facing_outer_face", factors(6, 0))};
}

/// Spheres as polyhedra of the same shape: their factors are those of the spheres, since every ray
/// from a convex body meets the closed one around it, and their areas are as the radii squared.
Comparisons compare_nested_spheres(const KnownFactor& known, const Context& context) {
  constexpr int kLevel = 1;  // its faces stay outside 0.93 of the sphere
  Scene scene = empty_scene("nested spheres");
  add_surface(scene, "in", icosphere(kLevel, known.params.at("r_in"), Facing::outwards));
  add_surface(scene, "out", icosphere(kLevel, known.params.at("r_out"), Facing::inwards));
  const study::Study assembly = assemble_raw(std::move(scene), kBodyTolerance, context);
  const Eigen::MatrixXd factors = surface_form_factors(assembly.mesh, *assembly.transport);
  const Eigen::MatrixXd errors = surface_form_factor_errors(assembly.mesh, *assembly.transport);
  const auto compare = [&](const char* key, Index from, Index to) {
    constexpr double kSigmasOfBody = 4;
    FactorComparison comparison = occluded(known, key, factors(from, to));
    comparison.kind = FactorKind::body;
    comparison.tolerance = kSigmasOfBody * errors(from, to) / comparison.expected + kAskedOfFactors;
    return comparison;
  };
  return {compare("F_in_out", 0, 1), compare("F_out_in", 1, 0), compare("F_out_out", 1, 1)};
}

Comparisons compare_curved_entry(const KnownFactor& known, const Context& /*context*/) {
  return compare_curved(known);
}

struct Comparer {
  const char* kind;  ///< as in the file
  Compare compare;
};

constexpr Comparer kComparers[] = {
    {"polygon-polygon unoccluded", compare_polygons},
    {"closed polyhedron, all unoccluded", compare_polyhedron},
    {"closed polyhedron", compare_polyhedron},
    {"point-to-polygon (Lambert)", compare_point},
    {"OCCLUDED, exact partial visibility", compare_screen},
    {"OCCLUDED, exact", compare_septum},
    {"occluded polyhedra, exact by convexity + reciprocity", compare_nested_cubes},
    {"occluded (inner sphere blocks outer-outer)", compare_nested_spheres},
    {"curved boundary", compare_curved_entry},
    {"closed curved enclosure", compare_curved_entry},
    {"curved", compare_curved_entry}};

/// Why entries of a kind are not form factors that can be compared; empty if they are.
std::string reason_to_leave_out(const std::string& kind) {
  if (kind == "crossed strings") return "two-dimensional: its surfaces are infinitely long";
  if (kind.starts_with("radiosity solution")) {
    return "a radiosity, no form factor: see furnace, cube and sphere";
  }
  return "";
}

}  // namespace

FactorComparisons compare_factors(const Context& context) {
  FactorComparisons result;
  for (const KnownFactor& known : read_known_factors(context.data)) {
    context.progress.check();
    if (const std::string reason = reason_to_leave_out(known.kind); !reason.empty()) {
      result.left_out.push_back(fmt::format("Not compared here: {} ({}).", known.name, reason));
      continue;
    }
    const auto* comparer =
        std::find_if(std::begin(kComparers), std::end(kComparers),
                     [&](const Comparer& candidate) { return known.kind == candidate.kind; });
    if (comparer == std::end(kComparers)) {
      throw SceneError(fmt::format("form-factors.json: '{}' is of the unknown kind '{}'",
                                   known.name, known.kind));
    }
    Comparisons found = comparer->compare(known, context);
    std::move(found.begin(), found.end(), std::back_inserter(result.comparisons));
  }
  return result;
}

}  // namespace apps::validation
