#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/validation/cases/asked.h"
#include "apps/validation/cases/cases.h"
#include "apps/validation/reference/built_scenes.h"
#include "apps/validation/reference/own_light.h"
#include "io/scene/scene_file.h"
#include "radiosity/assembly/transport_options.h"
#include "radiosity/solve/solution.h"
#include "radiosity/solve/solve.h"

namespace apps::validation {
namespace {

using namespace radiosity;

constexpr double kRoomReflectances[] = {0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95};

/// A room of 5 x 4 x 3 m; one quarter metre of the ceiling is the lamp.
Scene box_room() {
  Scene scene = empty_scene("box room");
  scene.closed = true;
  std::vector<Polygon> faces = box_faces(Vec3::Zero(), Vec3(5, 4, 3), Facing::inwards);
  const Polygon ceiling = faces[1];
  faces.erase(faces.begin() + 1);
  add_surface(scene, "walls and floor", faces);
  const Polygon lamp = parallelogram(Vec3(1.5, 1, 3), Vec3(0, 0.5, 0), Vec3(0.5, 0, 0));
  // The ceiling in four trapezoids around the lamp, whose corners come in the same order.
  std::vector<Polygon> around;
  for (std::size_t k = 0; k < 4; ++k) {
    const std::size_t next = (k + 1) % 4;
    around.push_back({ceiling[k], ceiling[next], lamp[next], lamp[k]});
  }
  add_surface(scene, "ceiling", around);
  add_surface(scene, "lamp", {lamp});
  return scene;
}

/// M = 1 W/m² on the surface of that name.
Eigen::VectorXd lamp_exitance(const study::Study& room, const std::string& name) {
  Eigen::VectorXd exitance = Eigen::VectorXd::Zero(room.mesh.size());
  for (Index i = 0; i < room.mesh.size(); ++i) {
    if (room.mesh.surface_names[room.mesh.surface[i]] == name) exitance[i] = 1;
  }
  return exitance;
}

void check_room(CaseResult& result, Plot& plot, const std::string& name,
                const std::string& lamp_name, const study::Study& room, const Progress& progress) {
  const Eigen::VectorXd area = areas(room.mesh);
  const double surface = area.sum();
  const auto n_columns = static_cast<Index>(std::size(kRoomReflectances));
  const Eigen::VectorXd exitance = lamp_exitance(room, lamp_name);
  const double power = area.dot(exitance);
  Eigen::MatrixXd reflectance(room.mesh.size(), n_columns);
  for (Index c = 0; c < n_columns; ++c) reflectance.col(c).setConstant(kRoomReflectances[c]);
  const Solution solution =
      solve(*room.transport, exitance.replicate(1, n_columns), reflectance,
            {.tolerance = kAskedOfSolver, .on_step = {}, .progress = progress});
  const Eigen::VectorXd direct = room.transport->apply(exitance);
  Series mean{name + ": mean", Series::Style::markers};
  Series law{"Φρ/(S(1-ρ))", Series::Style::line};
  Series least{name + ": least", Series::Style::dashed};
  double worst = 0;
  for (Index c = 0; c < n_columns; ++c) {
    const double rho = kRoomReflectances[c];
    const Eigen::VectorXd indirect = solution.irradiance.col(c) - direct;
    const double expected = power * rho / (surface * (1 - rho));
    const double computed = area.dot(indirect) / surface;
    const double norm = std::sqrt(area.dot(solution.radiosity.col(c).cwiseAbs2()));
    const double allowed = kAskedOfSolver * norm / std::sqrt(surface) +
                           kAskedOfRowSums * power / (surface * (1 - rho) * (1 - rho));
    worst = std::max(worst, std::abs(computed - expected) / allowed);
    mean.x.push_back(rho);
    mean.y.push_back(computed / (power / surface));
    law.y.push_back(rho / (1 - rho));
    least.y.push_back(indirect.minCoeff() / (power / surface));
  }
  law.x = least.x = mean.x;
  result.checks.push_back(
      {fmt::format("{}, {} reflectances: max |ΔE| / allowed", name, n_columns), worst, 1,
       "Allowed: the solver's bound 1e-8 ‖B‖ of the energy norm moves the mean over the area S by "
       "1e-8 ‖B‖/√S at most; row sums off by the promised 1e-10 change Φ/(S(1-ρ)) by "
       "1e-10/(1-ρ) of itself."});
  if (plot.series.empty()) plot.series.push_back(law);  // the same for every room
  plot.series.push_back(mean);
  plot.series.push_back(least);
}

}  // namespace

CaseResult run_room(const Context& context) {
  CaseResult result{
      .compared =
          "Mean indirect irradiance of closed rooms of uniform reflectance ρ, from 0.05 to "
          "0.95, lit by a small lamp of power Φ: a box of 5 x 4 x 3 m and the L-shaped room.",
      .reference =
          "E = Φρ/(S(1-ρ)), S the area of all surfaces, as for the integrating sphere; "
          "cf. CIE 171:2006, test case 5.8. Exact for any closed room if every surface, the "
          "lamp as well, has the same ρ, and if the mean is taken over all of them: by "
          "reciprocity and ΣF = 1 all that leaves arrives, Σ A H = Φ + ρ Σ A H, and the "
          "direct part of it is Φ. It is not exact in a point unless the room is a sphere: "
          "see the dashed curves."};
  Plot plot{"Indirect irradiance, relative to Φ/S",
            {"reflectance ρ"},
            {"E S / Φ", Axis::Scale::logarithmic},
            {}};
  const Progress quiet{.report = {}, .stop = context.progress.stop};
  const study::StudyOptions options{.patches = {.n_patches = 800}, .seed = context.seed};
  check_room(result, plot, "box", "lamp", study::assemble(box_room(), options, {.progress = quiet}),
             quiet);
  check_room(
      result, plot, "L-room", "light",
      study::assemble(io::read_scene(context.scenes / "l-room.json"), options, {.progress = quiet}),
      quiet);
  result.notes.emplace_back(
      "Dashed: the least indirect irradiance of any patch, which the relation does not predict.");
  result.figures.emplace_back(plot);
  return result;
}

}  // namespace apps::validation
