#include <fmt/format.h>

#include <cmath>

#include "apps/validation/cases/asked.h"
#include "apps/validation/cases/cases.h"
#include "apps/validation/reference/built_scenes.h"
#include "apps/validation/reference/known_factors.h"
#include "apps/validation/reference/own_light.h"
#include "radiosity/scene/radiometry.h"
#include "radiosity/solve/solution.h"

namespace apps::validation {
namespace {

using namespace radiosity;

constexpr const char* kBound =
    "The solver's guaranteed bound 1e-8 on ‖ΔB‖/‖B‖, which puts one patch off by 1e-8 ‖B‖/√A at "
    "most, and form factors that are off by 1e-9, amplified by 1/(1-ρ).";

/// Most that a patch of area `area` may be off, W/m².
double allowed(const study::Study& assembly, const Solution& solution, double area, double rho) {
  const double norm = std::sqrt(areas(assembly.mesh).dot(solution.radiosity.col(0).cwiseAbs2()));
  return (kAskedOfSolver + kAskedOfFactors / (1 - rho)) * norm / std::sqrt(area);
}

/// Two unit squares, `other` opposed or at a right angle, nothing else: B in closed form.
void check_open_pair(CaseResult& result, Table& table, const std::string& name,
                     const Polygon& other, double factor, const Context& context) {
  constexpr double kRho[] = {0.8, 0.6};
  constexpr double kExitance[] = {1, 0.25};
  Scene scene = empty_scene(name);
  scene.closed = false;
  add_surface(scene, "plate 1", {parallelogram(Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY())},
              {.reflectance = kRho[0], .exitance = kExitance[0]});
  add_surface(scene, "plate 2", {other}, {.reflectance = kRho[1], .exitance = kExitance[1]});
  const study::Study assembly =
      study::assemble(std::move(scene), {.patches = {.as_is = true}, .seed = context.seed});
  const Solution solution = solve_own_light(assembly, {.tolerance = kAskedOfSolver});
  for (int i = 0; i < 2; ++i) {
    const int j = 1 - i;
    const double expected = (kExitance[i] + kRho[i] * factor * kExitance[j]) /
                            (1 - kRho[0] * kRho[1] * factor * factor);
    const double computed = solution.radiosity(i, 0);
    result.checks.push_back({fmt::format("{}: |ΔB_{}|", name, i + 1), std::abs(computed - expected),
                             allowed(assembly, solution, 1, kRho[0]), kBound, "W/m²"});
    table.rows.push_back({fmt::format("{}: B_{}", name, i + 1), fmt::format("{:.10f}", computed),
                          fmt::format("{:.10f}", expected)});
  }
}

/// Heat that the surface loses, W.
double heat(const study::Study& assembly, const Solution& solution,
            const std::string& surface_part) {
  double sum = 0;
  for (Index i = 0; i < assembly.mesh.size(); ++i) {
    const std::string& name = assembly.mesh.surface_names[assembly.mesh.surface[i]];
    if (name != surface_part) continue;
    sum += assembly.mesh.area[i] * (solution.radiosity(i, 0) - solution.irradiance(i, 0));
  }
  return sum;
}

/// Area of the surface over how far its heat may be off: √(A_s) of B and of H each.
void add_heat(CaseResult& result, Table& table, const study::Study& assembly,
              const std::string& name, const std::string& surface, double area, double expected) {
  const Solution solution = solve_own_light(assembly, {.tolerance = kAskedOfSolver});
  const double computed = heat(assembly, solution, surface);
  const double norm = std::sqrt(areas(assembly.mesh).dot(solution.radiosity.col(0).cwiseAbs2()));
  result.checks.push_back(
      {fmt::format("{}: |ΔQ|", name), std::abs(computed - expected),
       2 * (kAskedOfSolver + kAskedOfFactors) * norm * std::sqrt(area),
       "Q = Σ A (B - H): B and H are each off by (1e-8 + 1e-9) ‖B‖ at most in the energy norm, the "
       "sum over the surface by √A times that (Cauchy and Schwarz).",
       "W"});
  table.rows.push_back({fmt::format("{}: Q, W", name), fmt::format("{:.8g}", computed),
                        fmt::format("{:.8g}", expected)});
}

constexpr double kHot = 400;   // K
constexpr double kCold = 290;  // K

double black_body_difference() {
  return kStefanBoltzmann * (std::pow(kHot, 4) - std::pow(kCold, 4));
}

/// A hot cube within a cold one: Q by the two-surface formula, F_12 = 1.
void check_cube_in_cube(CaseResult& result, Table& table, double side, double hot_emissivity,
                        double cold_emissivity, const Context& context) {
  Scene scene = empty_scene("cube in cube");
  scene.closed = true;
  add_surface(scene, "outer", box_faces(Vec3::Zero(), Vec3::Ones(), Facing::inwards),
              {.reflectance = 1 - cold_emissivity, .temperature = kCold});
  add_surface(
      scene, "inner",
      box_faces(Vec3::Constant(0.5 - side / 2), Vec3::Constant(0.5 + side / 2), Facing::outwards),
      {.reflectance = 1 - hot_emissivity, .temperature = kHot});
  const study::Study assembly = study::assemble(
      std::move(scene), {.patches = {.as_is = true}, .tolerance = 1e-7, .seed = context.seed});
  const double inner = 6 * side * side;
  const double resistance = (1 - hot_emissivity) / (hot_emissivity * inner) + 1 / inner +
                            (1 - cold_emissivity) / (cold_emissivity * 6);
  add_heat(
      result, table, assembly,
      fmt::format("cube of {} in unit cube, ε = {}, {}", side, hot_emissivity, cold_emissivity),
      "inner", inner, black_body_difference() / resistance);
}

/// Unit plates at distance 1 within four adiabatic (white) walls: a three-surface network.
void check_reradiating(CaseResult& result, Table& table, double factor, const Context& context) {
  constexpr double kHotEmissivity = 0.8;
  constexpr double kColdEmissivity = 0.5;
  Scene scene = empty_scene("plates with adiabatic walls");
  scene.closed = true;
  std::vector<Polygon> faces = box_faces(Vec3::Zero(), Vec3::Ones(), Facing::inwards);
  add_surface(scene, "hot", {faces[0]}, {.reflectance = 1 - kHotEmissivity, .temperature = kHot});
  add_surface(scene, "cold", {faces[1]},
              {.reflectance = 1 - kColdEmissivity, .temperature = kCold});
  faces.erase(faces.begin(), faces.begin() + 2);
  add_surface(scene, "walls", faces, {.reflectance = 1});
  const study::Study assembly =
      study::assemble(std::move(scene), {.patches = {.as_is = true}, .seed = context.seed});
  const double around = (1 - factor) / 2;  // two wall resistances in series
  const double resistance = (1 - kHotEmissivity) / kHotEmissivity + 1 / (factor + around) +
                            (1 - kColdEmissivity) / kColdEmissivity;
  add_heat(result, table, assembly, "plates with adiabatic walls, ε = 0.8, 0.5", "hot", 1,
           black_body_difference() / resistance);
}

}  // namespace

CaseResult run_plates(const Context& context) {
  CaseResult result{
      .compared =
          "Radiosity of two unit plates alone, opposed and at a right angle; net heat, by "
          "temperature and emissivity, between a cube and the cube around it, and between "
          "opposed plates within adiabatic walls. One patch per face.",
      .reference =
          "B_1 = (M_1 + ρ_1 F M_2)/(1 - ρ_1 ρ_2 F²); two-surface enclosure Q = "
          "σ(T_1⁴-T_2⁴) / ((1-ε_1)/(ε_1 A_1) + 1/(A_1 F_12) + (1-ε_2)/(ε_2 A_2)) and the "
          "three-surface network with a reradiating wall (Incropera & DeWitt, ch. 13; "
          "Modest, ch. 5). They presume uniform radiosity on each surface, which holds "
          "here by symmetry. F from tests/data/form-factors.json."};
  const std::vector<KnownFactor> known = read_known_factors(context.data);
  const double opposed = known_factor(known, "directly opposed, distance 1").value("F12");
  const double adjacent =
      known_factor(known, "perpendicular unit squares, common edge").value("F12");
  Table table{"Computed and in closed form", {"", "computed", "closed form"}, {}};
  check_open_pair(result, table, "opposed plates",
                  parallelogram(Vec3::UnitZ(), Vec3::UnitY(), Vec3::UnitX()), opposed, context);
  check_open_pair(result, table, "perpendicular plates",
                  parallelogram(Vec3::Zero(), Vec3::UnitY(), Vec3::UnitZ()), adjacent, context);
  check_cube_in_cube(result, table, 0.5, 0.8, 0.3, context);
  check_cube_in_cube(result, table, 0.98, 0.9, 0.9, context);
  check_reradiating(result, table, opposed, context);
  result.figures.emplace_back(table);
  return result;
}

}  // namespace apps::validation
