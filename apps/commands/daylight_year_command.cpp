#include "apps/commands/daylight_year_command.h"

#include <fmt/format.h>

#include <CLI/App.hpp>

#include "apps/run/daylight_hours.h"
#include "apps/run/daylight_points.h"
#include "apps/run/scene_input.h"
#include "apps/run/shown_events.h"
#include "apps/run/weather_hours.h"
#include "apps/summary/daylight_year_summary.h"
#include "apps/summary/summary.h"
#include "apps/terminal/machine.h"
#include "apps/terminal/output_files.h"
#include "radiosity/base/error.h"
#include "radiosity/base/parallel.h"
#include "radiosity/picture/point_grid.h"
#include "radiosity/scene/sun.h"
#include "radiosity/solve/quantity.h"

namespace apps {
namespace {

using radiosity::Index;
using radiosity::Vec3;

/// The photometric weights of the bands without their unit, or 1 each of heat: what a file's
/// illuminances, or irradiances, are shared by.
Eigen::VectorXd shares_of_bands(const radiosity::Scene& scene) {
  const Eigen::VectorXd weights = radiosity::luminous_weights(scene.bands);
  return weights.isZero(0) ? Eigen::VectorXd::Ones(scene.bands.count()).eval() : weights;
}

/// The scene by daylight: its sky tells where up is and what the ground reflects.
radiosity::Scene year_scene(radiosity::Scene scene) {
  if (!scene.sky) {
    scene.sky = radiosity::Sky{};
    scene.sky->ground_reflectance = Eigen::VectorXd::Constant(scene.bands.count(), 0.2);
  }
  scene.sky->zenith_radiance = Eigen::VectorXd::Ones(scene.bands.count());
  scene.environment = {};
  return study::daylight_scene(std::move(scene));
}

}  // namespace

DaylightYearCommand::DaylightYearCommand(CLI::App& program, Interruption& interruption)
    : interruption_(interruption) {
  CLI::App* command = program.add_subcommand("daylight-year",
                                             "Compute the daylight of points in the hours of a "
                                             "year of weather: one solve for each part of "
                                             "the sky, then products");
  add_common_options(*command, common_);
  command->add_option("--weather", weather_, "EnergyPlus weather file (.epw)")
      ->required()
      ->type_name("FILE");
  command
      ->add_option("-o,--output", common_.outputs,
                   "File of hours, with what each point gets: .csv; may be repeated")
      ->check([](const std::string& path) { return check_extension(path, {".csv"}); })
      ->type_name("FILE")
      ->allow_extra_args(false);
  add_daylight_place(*command, place_);
  command->add_option("--from", from_, "First hour of the day that counts begins then, o'clock")
      ->check(CLI::Range(0, 23))
      ->capture_default_str();
  command->add_option("--to", to_, "The last ends then, o'clock")
      ->check(CLI::Range(1, 24))
      ->capture_default_str();
  command->add_option("--threshold", threshold_, "Of the daylight autonomy, lx (W/m² of heat)")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command->add_option("--sky-parts", year_.n_parts, "Parts of the sky, at least")
      ->check(CLI::Range(4, 5000))
      ->capture_default_str()
      ->type_name("N");
  command
      ->add_option(
          "--north", north_,
          "Where north is: X,Y,Z; default: that of the scene's sky, or +y, or -z where y is up")
      ->delimiter(',')
      ->expected(3)
      ->type_name("X,Y,Z");
  add_compute_options(*command, compute_);
  add_transport_option(*command, compute_);
  add_memory_option(*command, compute_);
  command->callback([this] { run(); });
}

void DaylightYearCommand::run() const {
  keep_freed_memory();
  check_outputs(common_.outputs, common_.scene);
  check_against_inputs(common_.outputs, {weather_});
  if (place_.file) check_against_inputs(common_.outputs, {*place_.file});
  if (from_ >= to_) throw radiosity::SceneError("--from is not before --to");
  TerminalProgress terminal(terminal_style(common_));
  const radiosity::ThreadLimit threads(common_.n_threads);
  const study::StudyEvents events = shown_events(terminal, interruption_);
  const io::WeatherYear year = io::read_epw(weather_, events.progress);
  radiosity::Scene scene = year_scene(read_checked_scene(common_, events));
  const Vec3 up = scene.sky->up;
  const Vec3 north = scene.sky->north.value_or(radiosity::usual_north(up));
  const Compass compass{up, north_ ? Vec3((*north_)[0], (*north_)[1], (*north_)[2]) : north};
  if (!(up.cross(compass.north).norm() > 1e-6 * compass.north.norm())) {
    throw radiosity::SceneError("--north points up or down, or nowhere");
  }
  const bool is_photometric = !radiosity::luminous_weights(scene.bands).isZero(0);
  const WeatherHours weather = weather_hours(year, weather_, compass, is_photometric, from_, to_);
  for (const std::string& warning : weather.warnings) events.warn(warning);
  std::vector<study::DaylightPoint> points;
  if (place_.file) points = read_points(*place_.file, up, events.progress);
  const study::Study study = study::assemble(std::move(scene), compute_, events);
  if (!place_.file) {
    points = plane_points(study, place_.plane);
  }
  const Eigen::VectorXd weights = shares_of_bands(study.scene);
  const study::DaylightCoefficients coefficients =
      study::daylight_coefficients(study, points, weights, year_, events.progress);
  const Eigen::MatrixXd illuminance = illuminance_of_hours(
      weather, study::irradiance_in_hours(study, coefficients, points, weather.skies, weights,
                                          events.progress));
  for (const std::string& output : common_.outputs) {
    const auto lock = interruption_.hold();
    write_hours_csv(output, weather, illuminance);
  }
  const DaylightYearSummary summary{.study = study,
                                    .points = points,
                                    .years = points_of_year(illuminance, threshold_),
                                    .n_hours = illuminance.rows(),
                                    .n_light = static_cast<Index>(weather.skies.size()),
                                    .n_parts = coefficients.parts.size(),
                                    .threshold = threshold_,
                                    .is_photometric = is_photometric,
                                    .outputs = common_.outputs};
  print(common_.json ? daylight_year_json(summary, terminal.warnings())
                     : daylight_year_text(summary));
}

}  // namespace apps
