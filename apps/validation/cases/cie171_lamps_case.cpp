#include <fmt/format.h>

#include <cmath>
#include <string>
#include <vector>

#include "apps/validation/cases/asked.h"
#include "apps/validation/cases/cases.h"
#include "apps/validation/reference/built_scenes.h"
#include "apps/validation/reference/own_light.h"
#include "meshing/patches/patches.h"
#include "radiosity/scene/radiometry.h"
#include "radiosity/solve/solve.h"
#include "radiosity/visibility/incident_light.h"

namespace apps::validation {
namespace {

using namespace radiosity;

constexpr double kCubeEdge = 4;      // m
constexpr double kLampFlux = 10000;  // lm
constexpr double kPeak = 1000;       // cd
constexpr double kLampHeight = 3;    // m

/// Of 5.2, on the floor, m: about the point under the source.
const std::vector<Eigen::Vector2d>& floor_points() {
  static const std::vector<Eigen::Vector2d> points = {{0, 0},   {.5, 0},   {1, 0},    {1.5, 0},
                                                      {.5, .5}, {1, .5},   {1.5, .5}, {1, 1},
                                                      {1.5, 1}, {1.5, 1.5}};
  return points;
}

/// A luminaire of one lumen a watt, so that irradiances are lux.
void add_lamp(Scene& scene, const PhotometricWeb& web, const Vec3& position,
              const Eigen::Matrix3d& axes) {
  Photometry photometry;
  photometry.web = web;
  Luminaire lamp;
  lamp.name = "lamp";
  lamp.photometry = static_cast<int>(scene.photometries.size());
  lamp.position = position;
  lamp.axes = axes;
  lamp.watts_per_lumen = Eigen::VectorXd::Ones(1);
  scene.photometries.push_back(photometry);
  scene.luminaires.push_back(lamp);
}

/// I = I0 cos γ, given at the angles of the points.
PhotometricWeb cosine_web() {
  PhotometricWeb web{PhotometricWeb::Type::c, {}, {0}, {}};
  for (const Eigen::Vector2d& x : floor_points()) {
    web.polar.push_back(std::atan(x.norm() / kLampHeight));
  }
  web.polar.push_back(kPi / 2);
  std::sort(web.polar.begin(), web.polar.end());
  web.polar.erase(std::unique(web.polar.begin(), web.polar.end()), web.polar.end());
  web.intensity.resize(static_cast<Index>(web.polar.size()), 1);
  for (Index k = 0; k < web.intensity.rows(); ++k) {
    web.intensity(k, 0) = kPeak * std::cos(web.polar[static_cast<std::size_t>(k)]);
  }
  return web;
}

PhotometricWeb even_web(double flux) {
  return {PhotometricWeb::Type::c, {0, kPi}, {0}, Eigen::Vector2d::Constant(flux / (4 * kPi))};
}

/// 5.2: E = I0 h²/d⁴ under a source of I0 cos γ.
void check_floor(CaseResult& result, Table& table) {
  constexpr double kOfRounding = 1e-11;
  double worst = 0;
  for (const double turn : {0.0, 0.7}) {
    const Eigen::Matrix3d axes = Eigen::AngleAxisd(turn, Vec3(1, 2, 3).normalized()).matrix();
    const Vec3 step = turn * Vec3(12.5, -7.25, 3.5);
    Scene scene = empty_scene("CIE 171 floor");
    Polygon floor = parallelogram(Vec3(-2, -2, 0), Vec3(4, 0, 0), Vec3(0, 4, 0));
    for (Vec3& corner : floor) corner = axes * corner + step;
    add_surface(scene, "floor", {floor});
    add_lamp(scene, cosine_web(), axes * Vec3(0, 0, kLampHeight) + step, axes);
    const PatchMesh mesh = meshing::make_patches(scene, {.max_edge = 1});
    const IncidentLight light(scene, mesh);
    for (const Eigen::Vector2d& place : floor_points()) {
      const Vec3 x(place.x(), place.y(), 0);
      Eigen::VectorXd lux = Eigen::VectorXd::Zero(1);
      light.add(axes * x + step, axes.col(2), lux);
      const double exact =
          kPeak * square(kLampHeight) / square(x.squaredNorm() + square(kLampHeight));
      worst = std::max(worst, std::abs(lux[0] / exact - 1));
      if (turn > 0) continue;
      table.rows.push_back({fmt::format("5.2 point source, ({}, {})", x.x(), x.y()),
                            fmt::format("{:.6f}", lux[0]), fmt::format("{:.6f}", exact)});
    }
  }
  result.checks.push_back({"5.2 point source, also turned and moved: max |ΔE| / E", worst,
                           kOfRounding,
                           "The file's angles are those of the points, where its intensity is "
                           "exact; rounding of coordinates of 15 m next to 3 m."});
}

/// 5.4 and 5.8: all light of a lamp in a cube arrives, and its reflections sum to ρΦ/(S(1-ρ)).
void check_lamp_in_cube(CaseResult& result, Table& table, const Context& context) {
  Scene scene = empty_scene("CIE 171 cube with a lamp");
  scene.closed = true;
  add_surface(scene, "cube", box_faces(Vec3::Zero(), Vec3::Constant(kCubeEdge), Facing::inwards));
  add_lamp(scene, even_web(kLampFlux), Vec3::Constant(kCubeEdge / 2), Eigen::Matrix3d::Identity());
  const study::Study cube =
      study::assemble(std::move(scene), {.patches = {.max_edge = 0.5}, .seed = context.seed});
  const Eigen::MatrixXd direct = incident_irradiance(cube.scene, cube.mesh);
  const Eigen::VectorXd area = areas(cube.mesh);
  constexpr double kFluxError = 1e-9;
  result.checks.push_back({"5.4 flux conservation: |arrived / emitted - 1|",
                           std::abs(area.dot(direct.col(0)) / kLampFlux - 1), kFluxError,
                           "The flux through patches is an integral along their borders, right to "
                           "1e-9; those that share an edge err alike."});
  double worst = 0;
  for (const double rho : {.05, .3, .6, .9, .95}) {
    SolveOptions options{.tolerance = kAskedOfSolver};
    options.incident = direct;
    options.progress = {.report = {}, .stop = context.progress.stop};
    const Solution solution = solve(*cube.transport, Eigen::MatrixXd::Zero(area.size(), 1),
                                    Eigen::MatrixXd::Constant(area.size(), 1, rho), options);
    const double surface = area.sum();
    const double computed = area.dot(solution.irradiance.col(0) - direct.col(0)) / surface;
    const double expected = rho * kLampFlux / (surface * (1 - rho));
    const double norm = std::sqrt(area.dot(solution.radiosity.col(0).cwiseAbs2()));
    const double allowed = kAskedOfSolver * norm / std::sqrt(surface) + kFluxError * expected +
                           kAskedOfRowSums * kLampFlux / (surface * (1 - rho) * (1 - rho));
    worst = std::max(worst, std::abs(computed - expected) / allowed);
    table.rows.push_back({fmt::format("5.8 mean indirect, ρ = {}", rho),
                          fmt::format("{:.6f}", computed), fmt::format("{:.6f}", expected)});
  }
  result.checks.push_back({"5.8 mean indirect illuminance: max |ΔE| / allowed", worst, 1,
                           "Allowed: the solver's bound 1e-8 ‖B‖/√S of the mean, row sums to the "
                           "promised 1e-10, and the flux to 1e-9."});
}

}  // namespace

CaseResult run_cie171_lamps(const Context& context) {
  CaseResult result{
      .compared =
          "CIE 171:2006, test cases to assess lighting programs, those of luminaires: 5.2 "
          "(point source), 5.4 and 5.8 (flux conservation and internal reflection) with a "
          "source in the middle of a cube of 4 m.",
      .reference = "Closed forms: I0 h²/d⁴; 10,000 lm; ρΦ/(S(1-ρ))."};
  Table table{"Computed and exact, lx", {"", "computed", "exact"}, {}};
  check_floor(result, table);
  check_lamp_in_cube(result, table, context);
  result.notes.emplace_back(
      "The report's table of 5.2 differs from the closed form by up to 0.03 %, its own numerics.");
  result.figures.emplace_back(table);
  return result;
}

}  // namespace apps::validation
