#include "viewer/script/script_actions.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <utility>

#include "io/base/atomic_file.h"
#include "radiosity/base/error.h"
#include "viewer/script/camera_actions.h"
#include "viewer/script/comparison_actions.h"
#include "viewer/script/console_actions.h"
#include "viewer/script/coupling_actions.h"
#include "viewer/script/daylight_actions.h"
#include "viewer/script/grid_actions.h"
#include "viewer/script/help_actions.h"
#include "viewer/script/luminaire_actions.h"
#include "viewer/script/meter_actions.h"
#include "viewer/script/state_report.h"
#include "viewer/script/surface_actions.h"

namespace viewer {
namespace {

using nlohmann::json;

constexpr double kPatience = 600;  // s, that a script waits unless it says otherwise

std::string last_error(const Session& session) {
  const auto& messages = session.messages();
  const auto found = std::find_if(messages.rbegin(), messages.rend(), [](const Message& message) {
    return message.is_error && !message.is_past;
  });
  return found == messages.rend() ? "no light was found" : found->text;
}

void check_patience(const Stage& stage, ScriptArguments& arguments) {
  const double patience = arguments.number_or("timeout", kPatience);
  if (stage.seconds > patience) {
    throw std::runtime_error(fmt::format("was not done within {} s", patience));
  }
}

bool wait_solved(Stage& stage, ScriptArguments& arguments) {
  check_patience(stage, arguments);
  const Session& session = stage.desk.session;
  if (stage.is_first || !session.is_settled() || session.is_paused()) return false;
  if (session.refusal()) throw std::runtime_error(*session.refusal());
  if (!is_solved(session)) throw std::runtime_error(last_error(session));
  return true;
}

bool wait_idle(Stage& stage, ScriptArguments& arguments) {
  check_patience(stage, arguments);
  return !stage.is_first && stage.desk.session.is_idle() && !is_measuring(stage.desk) &&
         !stage.desk.examples.is_busy();
}

/// Until a person, or what acts as one, presses a function key: all keys before it have been taken
/// in by then.
bool wait_key(Stage& stage, ScriptArguments& arguments) {
  check_patience(stage, arguments);
  const std::string name = arguments.text("key");
  if (stage.is_first) stage.desk.function_key.reset();
  return stage.desk.function_key && name == fmt::format("F{}", *stage.desk.function_key);
}

void load(Stage& stage, ScriptArguments& arguments) { stage.host.open(arguments.text("scene")); }

void select_patch(Stage& stage, ScriptArguments& arguments) {
  if (arguments.value("patch").is_null()) {
    stage.desk.session.select(std::nullopt);
  } else {
    stage.desk.session.select(arguments.integer("patch"));
  }
}

void select_at(Stage& stage, ScriptArguments& arguments) {
  stage.desk.session.select(patch_at(stage.desk, arguments.number("x"), arguments.number("y")));
}

io::ColorScale range_of(ScriptArguments& arguments) {
  const Eigen::VectorXd range = arguments.numbers("range");
  if (range.size() != 2 || !(range[0] < range[1])) {
    throw std::invalid_argument("'range' needs two numbers, the first one smaller");
  }
  return {.low = range[0], .high = range[1]};
}

void set_quantity(Stage& stage, ScriptArguments& arguments) {
  Look& look = stage.desk.look;
  show(stage.desk, arguments.text("quantity"));
  look.logarithmic = arguments.flag_or("log", look.logarithmic);
  look.band.reset();
  if (arguments.has("band")) {
    const long band = arguments.integer("band");
    if (band < 0 || band >= stage.desk.session.model().bands.count()) {
      throw std::invalid_argument(fmt::format("there is no band {}", band));
    }
    look.band = band;
  }
  if (arguments.has("range")) look.range = range_of(arguments);
}

void set_legend(Stage& stage, ScriptArguments& arguments) {
  Look& look = stage.desk.look;
  if (arguments.has("map")) {
    const std::string name = arguments.text("map");
    const auto map = io::color_map_named(name);
    if (!map) throw std::invalid_argument("no colours are called '" + name + "'");
    look.map = *map;
  }
  look.logarithmic = arguments.flag_or("log", look.logarithmic);
  look.isolines = arguments.flag_or("isolines", look.isolines);
  if (arguments.has("step")) {
    const double step = arguments.number("step");
    if (!(step >= 0)) throw std::invalid_argument("'step' must be at least 0");
    look.tick_spacing = step > 0 ? std::optional(step) : std::nullopt;
  }
  if (arguments.has("range")) look.range = range_of(arguments);
  if (!arguments.has("fit")) return;
  const Eigen::VectorXd fit = arguments.numbers("fit");
  if (fit.size() != 2 || !(fit[0] >= 0 && fit[0] < fit[1] && fit[1] <= 100)) {
    throw std::invalid_argument("'fit' needs two percentages, the first one smaller");
  }
  look.fit = {.low_percent = fit[0], .high_percent = fit[1]};
  if (!arguments.has("range")) look.range.reset();
}

void set_exposure(Stage& stage, ScriptArguments& arguments) {
  if (arguments.value("stops") == "auto") {
    stage.desk.look.stops = 0;
    stage.desk.is_exposure_due = true;
  } else {
    stage.desk.look.stops = arguments.number("stops");
  }
}

void set_look(Stage& stage, ScriptArguments& arguments) {
  Desk& desk = stage.desk;
  desk.look.smooth = arguments.flag_or("smooth", desk.look.smooth);
  desk.look.edges = arguments.flag_or("edges", desk.look.edges);
  desk.look.outlines = arguments.flag_or("outlines", desk.look.outlines);
  desk.look.hide_backs = arguments.flag_or("hide_backs", desk.look.hide_backs);
  desk.look.back_outlines = arguments.flag_or("back_outlines", desk.look.back_outlines);
  desk.look.axes = arguments.flag_or("axes", desk.look.axes);
  desk.look.luminaires = arguments.flag_or("luminaires", desk.look.luminaires);
  desk.look.polar_curves = arguments.flag_or("polar_curves", desk.look.polar_curves);
  desk.shows_panels = arguments.flag_or("panels", desk.shows_panels);
  desk.shows_help = arguments.flag_or("help", desk.shows_help);
}

std::size_t emitter_of(const Stage& stage, ScriptArguments& arguments) {
  const std::string name = arguments.name("emitter");
  const auto emitter = emitter_named(stage.desk.session.mix(), name);
  if (emitter) return *emitter;
  std::string known;
  for (const Emitter& other : stage.desk.session.mix().emitters) known += " '" + other.name + "'";
  throw std::invalid_argument(fmt::format("no emitter is called '{}'; there are{}", name, known));
}

void make_lamp(Stage& stage, ScriptArguments& arguments) {
  Session& session = stage.desk.session;
  const std::string name = arguments.name("surface");
  if (!session.is_open()) throw std::runtime_error("there is no scene");
  const auto surface = surface_named(*session.model().mesh, name);
  if (!surface) throw std::invalid_argument(fmt::format("no surface is called '{}'", name));
  viewer::make_lamp(stage.desk, *surface, arguments.number("lumens"));
}

void set_emitter(Stage& stage, ScriptArguments& arguments) {
  Session& session = stage.desk.session;
  const std::size_t e = emitter_of(stage, arguments);
  const Emitter& emitter = session.mix().emitters[e];
  session.begin_mix_step();
  session.set_emitter(e, arguments.number_or("scale", emitter.scale),
                      arguments.flag_or("on", emitter.is_on));
}

void toggle_emitter(Stage& stage, ScriptArguments& arguments) {
  Session& session = stage.desk.session;
  const std::size_t e = emitter_of(stage, arguments);
  const Emitter& emitter = session.mix().emitters[e];
  session.begin_mix_step();
  session.set_emitter(e, emitter.scale, !emitter.is_on);
}

std::size_t material_of(const Stage& stage, ScriptArguments& arguments) {
  const Session& session = stage.desk.session;
  const std::string name = arguments.name("material");
  const std::size_t n_materials = session.mix().reflectance.size();
  std::size_t m = 0;
  while (m < n_materials && session.model().scene->materials[m].name != name) ++m;
  if (m == n_materials) throw std::invalid_argument("no material is called '" + name + "'");
  return m;
}

void set_reflectance(Stage& stage, ScriptArguments& arguments) {
  Session& session = stage.desk.session;
  const std::size_t m = material_of(stage, arguments);
  session.begin_mix_step();
  if (arguments.value("value").is_array()) {
    session.set_reflectance(m, arguments.numbers("value"));
    return;
  }
  const double mean = arguments.number("value");
  if (!(mean >= 0 && mean <= 1)) throw std::invalid_argument("'value' must be in [0, 1]");
  session.set_reflectance(m, with_mean_reflectance(session.original_mix().reflectance[m], mean));
}

void undo(Session& session) {
  if (!session.mix_history().can_undo()) throw std::runtime_error("there is nothing to undo");
  session.undo_mix();
}

void redo(Session& session) {
  if (!session.mix_history().can_redo()) throw std::runtime_error("there is nothing to redo");
  session.redo_mix();
}

void restart(Stage& stage, ScriptArguments& arguments) {
  study::StudyOptions options = stage.desk.session.options();
  meshing::PatchChoice& patches = options.patches;
  patches.as_is = false;
  patches.adaptive = arguments.flag_or("adaptive", patches.adaptive);
  if (arguments.has("patches")) {
    patches.n_patches = arguments.integer("patches");
    patches.max_edge.reset();
  }
  if (arguments.has("max_edge")) {
    patches.max_edge = arguments.number("max_edge");
    patches.n_patches.reset();
  }
  if (patches.n_patches && *patches.n_patches < 1) {
    throw std::invalid_argument("'patches' must be at least 1");
  }
  if (patches.max_edge && !(*patches.max_edge > 0)) {
    throw std::invalid_argument("'max_edge' must be above 0");
  }
  stage.desk.session.restart(options);
}

void record(Stage& stage, ScriptArguments& arguments) {
  const std::string name = arguments.text("method");
  const auto method = radiosity::method_named(name);
  if (!method) {
    throw std::invalid_argument("no method is called '" + name +
                                "'; there are cg, jacobi, gauss-seidel, southwell, chebyshev");
  }
  record_iteration(stage.desk, *method);
}

void set_watch(Stage& stage, ScriptArguments& arguments) {
  Desk& desk = stage.desk;
  const double speed = arguments.number_or("speed", desk.watching.speed);
  if (!(speed >= kSlowest && speed <= kFastest)) {
    throw std::invalid_argument(
        fmt::format("'speed' must be from {} to {} steps per second", kSlowest, kFastest));
  }
  desk.watching.speed = speed;
  desk.watching.is_logarithmic = arguments.flag_or("log", desk.watching.is_logarithmic);
  if (!arguments.has("playing")) return;
  if (arguments.flag_or("playing", false)) {
    play_iteration(desk, speed);
  } else {
    desk.watching.is_playing = false;
  }
}

void set_step(Stage& stage, ScriptArguments& arguments) {
  const IterationRecord* record = stage.desk.session.iteration();
  if (record == nullptr) throw std::runtime_error("no iteration is recorded");
  const std::size_t last = record->frames.size() - 1;
  const json& step = arguments.value("step");
  if (step == "last") {
    stage.desk.look.step = last;
    return;
  }
  const long wanted = arguments.integer("step");
  if (wanted < 0) throw std::invalid_argument("'step' must be at least 0");
  stage.desk.look.step = std::min(static_cast<std::size_t>(wanted), last);
}

void write_report(Stage& stage, ScriptArguments& arguments) {
  const std::string file = arguments.text("file");
  json report = state_report(stage.desk);
  report["frame_times"] = stage.host.frame_times();
  check_output(stage.desk, file);
  io::write_stream_atomically(file,
                              [&](std::ofstream& stream) { stream << report.dump(1) << '\n'; });
}

/// Waits until the result is written.
bool save(Stage& stage, ScriptArguments& arguments) {
  const std::string file = arguments.text("file");
  if (stage.is_first) begin_save_result(stage.desk, file);
  if (!stage.desk.saving.empty()) return false;
  if (stage.desk.save_error) throw radiosity::OutputError(*stage.desk.save_error);
  return true;
}

/// Waits until the picture has been drawn and written.
bool screenshot(Stage& stage, ScriptArguments& arguments) {
  const std::string file = arguments.text("file");
  if (stage.is_first) stage.desk.screenshot = file;
  return !stage.desk.screenshot;
}

std::map<std::string, ActionKind> general_actions() {
  return {
      {"load", {"scene", at_once(load)}},
      {"wait-solved", {"timeout", wait_solved}},
      {"wait-idle", {"timeout", wait_idle}},
      {"wait-key", {"key", wait_key}},
      {"wait",
       {"seconds",
        [](Stage& stage, ScriptArguments& arguments) {
          return stage.seconds >= arguments.number("seconds");
        }}},
      {"select-patch", {"patch", at_once(select_patch)}},
      {"select-at", {"", at_once(select_at)}},
      {"set-quantity", {"quantity", at_once(set_quantity)}},
      {"set-legend", {"map", at_once(set_legend)}},
      {"set-exposure", {"stops", at_once(set_exposure)}},
      {"set-look", {"", at_once(set_look)}},
      {"set-unit", {"unit", at_once([](Stage& stage, ScriptArguments& arguments) {
                      set_unit(stage.desk, arguments.text("unit"));
                    })}},
      {"set-emitter", {"emitter", at_once(set_emitter)}},
      {"toggle-emitter", {"emitter", at_once(toggle_emitter)}},
      {"make-lamp", {"surface", at_once(make_lamp)}},
      {"set-reflectance", {"material", at_once(set_reflectance)}},
      {"reset-emitter", {"emitter", at_once([](Stage& stage, ScriptArguments& arguments) {
                           stage.desk.session.reset_emitter(emitter_of(stage, arguments));
                         })}},
      {"reset-material", {"material", at_once([](Stage& stage, ScriptArguments& arguments) {
                            stage.desk.session.reset_material(material_of(stage, arguments));
                          })}},
      {"undo", {"", at_once([](Stage& stage, ScriptArguments&) { undo(stage.desk.session); })}},
      {"redo", {"", at_once([](Stage& stage, ScriptArguments&) { redo(stage.desk.session); })}},
      {"reset-scene",
       {"", at_once([](Stage& stage, ScriptArguments&) { stage.desk.session.reset_mix(); })}},
      {"restart", {"patches", at_once(restart)}},
      {"pause",
       {"", at_once([](Stage& stage, ScriptArguments&) { stage.desk.session.set_paused(true); })}},
      {"resume",
       {"", at_once([](Stage& stage, ScriptArguments&) { stage.desk.session.set_paused(false); })}},
      {"stop", {"", at_once([](Stage& stage, ScriptArguments&) { stage.desk.session.stop(); })}},
      {"light-path", {"on", at_once([](Stage& stage, ScriptArguments& arguments) {
                        stage.desk.asks_light_path = arguments.flag_or("on", true);
                      })}},
      {"record-iteration", {"method", at_once(record)}},
      {"set-step", {"step", at_once(set_step)}},
      {"set-watch", {"playing", at_once(set_watch)}},
      {"screenshot", {"file", screenshot}},
      {"save-result", {"file", save}},
      {"save-scene", {"file", at_once([](Stage& stage, ScriptArguments& arguments) {
                        save_scene(stage.desk, arguments.text("file"));
                      })}},
      {"resize", {"", at_once([](Stage& stage, ScriptArguments& arguments) {
                    stage.host.resize(static_cast<int>(arguments.integer("width")),
                                      static_cast<int>(arguments.integer("height")));
                  })}},
      {"report", {"file", at_once(write_report)}},
      {"forget-frame-times",
       {"", at_once([](Stage& stage, ScriptArguments&) { stage.host.forget_frame_times(); })}}};
}

}  // namespace

const std::map<std::string, ActionKind>& action_kinds() {
  static const std::map<std::string, ActionKind> kinds = [] {
    std::map<std::string, ActionKind> all = general_actions();
    all.merge(camera_actions());
    all.merge(comparison_actions());
    all.merge(console_actions());
    all.merge(coupling_actions());
    all.merge(daylight_actions());
    all.merge(grid_actions());
    all.merge(help_actions());
    all.merge(luminaire_actions());
    all.merge(meter_actions());
    all.merge(surface_actions());
    return all;
  }();
  return kinds;
}

}  // namespace viewer
