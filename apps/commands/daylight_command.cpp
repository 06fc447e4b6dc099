#include "apps/commands/daylight_command.h"

#include <fmt/format.h>

#include <CLI/App.hpp>

#include "apps/run/daylight_points.h"
#include "apps/run/scene_input.h"
#include "apps/run/shown_events.h"
#include "apps/summary/daylight_summary.h"
#include "apps/summary/summary.h"
#include "apps/terminal/machine.h"
#include "apps/terminal/output_files.h"
#include "radiosity/base/parallel.h"
#include "radiosity/picture/point_grid.h"
#include "radiosity/solve/quantity.h"
#include "radiosity/visibility/sky_light.h"

namespace apps {
namespace {

using radiosity::Index;
using radiosity::PointPlace;

/// What makes one value of the bands: their photometric weights, or 1 each of heat.
Eigen::VectorXd weights_of(const radiosity::Scene& scene, const PhotometryOptions& photometry) {
  const Eigen::VectorXd weights =
      radiosity::luminous_weights(scene.bands, photometry.efficacy_or_default());
  return weights.isZero(0) ? Eigen::VectorXd::Ones(scene.bands.count()).eval() : weights;
}

bool is_photometric(const radiosity::Scene& scene) {
  return !radiosity::luminous_weights(scene.bands).isZero(0);
}

}  // namespace

DaylightCommand::DaylightCommand(CLI::App& program, Interruption& interruption)
    : interruption_(interruption) {
  CLI::App* command = program.add_subcommand(
      "daylight",
      "Compute daylight factors: sky, external and internal components on a work plane or at "
      "points");
  add_common_options(*command, common_);
  command
      ->add_option("-o,--output", common_.outputs,
                   "File of points with their daylight factors: .csv; may be repeated")
      ->check([](const std::string& path) { return check_extension(path, {".csv"}); })
      ->type_name("FILE")
      ->allow_extra_args(false);
  add_daylight_place(*command, place_);
  command
      ->add_option("--outdoors", outdoors_,
                   "Surfaces that stand outdoors (* and ? as in file names): what they reflect is "
                   "the external component; may be repeated")
      ->type_name("NAME")
      ->allow_extra_args(false);
  add_compute_options(*command, compute_);
  add_transport_option(*command, compute_);
  add_memory_option(*command, compute_);
  add_photometry_options(*command, photometry_);
  command->callback([this] { run(); });
}

study::Study DaylightCommand::make_light(const study::StudyEvents& events) const {
  radiosity::Scene scene = study::daylight_scene(read_checked_scene(common_, events));
  std::vector<std::string> names;
  for (const radiosity::Surface& surface : scene.surfaces) names.push_back(surface.name);
  (void)study::outdoor_surfaces(names, outdoors_);
  return study::run(std::move(scene), compute_, events);
}

std::vector<study::DaylightPoint> DaylightCommand::make_points(
    const study::Study& study, const radiosity::Progress& progress) const {
  const radiosity::Vec3& up = study.scene.sky->up;
  if (place_.file) return read_points(*place_.file, up, progress);
  return plane_points(study, place_.plane);
}

void DaylightCommand::run() const {
  keep_freed_memory();
  check_outputs(common_.outputs, common_.scene);
  if (place_.file) check_against_inputs(common_.outputs, {*place_.file});
  TerminalProgress terminal(terminal_style(common_));
  const radiosity::ThreadLimit threads(common_.n_threads);
  const study::StudyEvents events = shown_events(terminal, interruption_);
  if (place_.file) (void)read_points(*place_.file, radiosity::Vec3::UnitZ(), events.progress);
  const study::Study study = make_light(events);
  const std::vector<study::DaylightPoint> points = make_points(study, events.progress);
  const std::vector<PointPlace> places = study::daylight_places(study, points);
  const Eigen::VectorXd weights = weights_of(study.scene, photometry_);
  const std::vector<study::DaylightFactor> factors =
      study::daylight_factors(study, points, outdoors_, weights, events.progress);
  for (const std::string& output : common_.outputs) {
    const auto lock = interruption_.hold();
    write_daylight_csv(output, points, places, factors);
  }
  const DaylightSummary summary{
      .study = study,
      .points = points,
      .places = places,
      .factors = factors,
      .horizontal = weights.dot(radiosity::horizontal_irradiance(*study.scene.sky)),
      .is_photometric = is_photometric(study.scene),
      .outputs = common_.outputs};
  print(common_.json ? daylight_json(summary, terminal.warnings()) : daylight_text(summary));
}

}  // namespace apps
