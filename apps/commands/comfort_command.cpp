#include "apps/commands/comfort_command.h"

#include <fmt/format.h>

#include <CLI/App.hpp>

#include "apps/run/assembled_scene.h"
#include "apps/run/shown_events.h"
#include "apps/summary/comfort_summary.h"
#include "apps/summary/summary.h"
#include "apps/terminal/machine.h"
#include "apps/terminal/number_list.h"
#include "apps/terminal/output_files.h"
#include "io/result/comfort_csv.h"
#include "radiosity/base/error.h"
#include "radiosity/base/parallel.h"
#include "radiosity/solve/surface_flux.h"

namespace apps {
namespace {

using radiosity::Vec3;

std::string check_three_numbers(const std::string& text) {
  if (as_numbers(text, 3)) return "";
  return fmt::format("found '{}', expected x,y,z", text);
}

std::string check_way(const std::string& text) {
  const auto numbers = as_numbers(text, 3);
  if (numbers && Vec3(numbers->data()).norm() > 0) return "";
  return fmt::format("found '{}', expected a direction x,y,z", text);
}

Vec3 vector_of(const std::string& text) { return Vec3(as_numbers(text, 3)->data()); }

}  // namespace

ComfortCommand::ComfortCommand(CLI::App& program, Interruption& interruption)
    : interruption_(interruption) {
  CLI::App* command = program.add_subcommand(
      "comfort", "Tell the mean radiant temperature of a person at points, and its form factors");
  add_common_options(*command, common_);
  command->add_option("--at", at_, "Where the middle of the person is, metres; may be repeated")
      ->check(check_three_numbers)
      ->type_name("x,y,z")
      ->allow_extra_args(false);
  command->add_option("--points", points_, "Further points, from a .csv with columns x,y,z")
      ->type_name("FILE");
  command->add_option("--posture", posture_, "Of the person")
      ->check(CLI::IsMember({"standing", "seated"}))
      ->capture_default_str()
      ->type_name("P");
  command
      ->add_option("--body", body_,
                   "How it takes up radiation: six-planes (ISO 7726) or projected-area (Fanger)")
      ->check(CLI::IsMember({"six-planes", "projected-area"}))
      ->capture_default_str()
      ->type_name("B");
  command
      ->add_option("--facing", facing_,
                   "Direction that the person looks to; default: turned to all sides alike")
      ->check(check_way)
      ->type_name("x,y,z");
  command->add_option("--up", up_, "What is up")
      ->check(check_way)
      ->capture_default_str()
      ->type_name("x,y,z");
  command->add_option("-o,--output", common_.outputs, "Table (.csv); may be repeated")
      ->check([](const std::string& path) { return check_extension(path, {".csv"}); })
      ->type_name("FILE")
      ->allow_extra_args(false);
  add_heat_options(*command, common_.heat);
  add_assembly_options(*command, compute_, operator_);
  command->callback([this] { run(); });
}

std::vector<Vec3> ComfortCommand::points(const radiosity::Progress& progress) const {
  std::vector<Vec3> result;
  for (const std::string& text : at_) result.push_back(vector_of(text));
  if (points_) {
    const auto more = io::read_points_csv(*points_, progress);
    result.insert(result.end(), more.begin(), more.end());
  }
  return result;
}

study::ComfortOptions ComfortCommand::comfort_options() const {
  study::ComfortOptions options{.posture = *study::posture_named(posture_),
                                .body = *study::body_model_named(body_),
                                .up = vector_of(up_).normalized()};
  if (facing_) options.facing = vector_of(*facing_);
  return options;
}

void ComfortCommand::run() const {
  if (at_.empty() && !points_) throw CLI::RequiredError("--at or --points");
  keep_freed_memory();
  check_outputs(common_.outputs, common_.scene);
  if (points_) check_against_inputs(common_.outputs, {*points_});
  TerminalProgress terminal(terminal_style(common_));
  const radiosity::ThreadLimit threads(common_.n_threads);
  study::StudyEvents events = shown_events(terminal, interruption_);
  const std::vector<Vec3> places = points(events.progress);
  study::ComfortOptions options = comfort_options();
  options.progress = events.progress;
  events.divided = [&](const radiosity::Scene& scene, const study::Patches& /*patches*/) {
    study::check_comfort(scene, options);
  };
  const study::Study solved =
      study::with_light(assemble_scene(common_, compute_, operator_, events), compute_, events);
  const ComfortSummary summary{.study = solved,
                               .points = study::comfort(solved, places, options),
                               .posture = posture_,
                               .body = body_,
                               .outputs = common_.outputs};
  std::vector<io::ComfortRow> rows;
  for (const study::ComfortPoint& point : summary.points) {
    rows.push_back({point.position, point.mean_radiant_temperature, point.plane_temperatures,
                    point.surfaces, point.backs, point.sky});
  }
  for (const std::string& output : common_.outputs) {
    const auto lock = interruption_.hold();
    io::write_comfort_csv(output, solved.mesh.surface_names, rows);
  }
  print(common_.json ? comfort_json(summary, terminal.warnings()) : comfort_text(summary));
}

}  // namespace apps
