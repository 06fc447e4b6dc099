#include "viewer/desk/desk.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "io/base/output_check.h"
#include "io/result/result_file.h"
#include "io/scene/read_options.h"
#include "io/scene/scene_writer.h"
#include "radiosity/base/error.h"
#include "radiosity/picture/render.h"
#include "radiosity/scene/patch_mesh.h"
#include "viewer/desk/asking.h"
#include "viewer/desk/couplings.h"
#include "viewer/work/standing.h"

namespace viewer {

using radiosity::Index;

namespace {

/// Of more patches grids are measured when somebody asks for it.
constexpr Index kMostMeasured = 30'000;

Domain domain_of(const Session& session) {
  if (session.is_thermal()) return Domain::heat;
  const bool is_dark = !session.model().scene && session.light() == nullptr;
  return is_dark ? Domain::factors : Domain::light;
}

/// What a person set for the last file would hide the new one.
void greet(Desk& desk) {
  const Session& session = desk.session;
  desk.shown_file = session.versions().file;
  desk.look.range.reset();
  desk.look.logarithmic = is_wide(desk.look.show);
  desk.look.band.reset();
  desk.views = session.model().scene ? session.model().scene->views : std::vector<SavedView>{};
  desk.tape = {};
  desk.meter.reset();
  desk.network.reset();
  desk.plan.reset();
  desk.plan.set_wanted(has_light_plan(session) && session.model().mesh->size() <= kMostMeasured);
  desk.look.grid = {};
  desk.look.tick_spacing.reset();
  desk.is_meter_in_hand = false;
  desk.look.hidden = {};
  desk.marks.mark({});
  desk.chosen_luminaire.reset();
  desk.hovered_luminaire.reset();
  const Domain domain = domain_of(session);
  const Show shown = desk.look.show;
  const bool is_of_last_file = shown == Show::watched || shown == Show::unshot || is_plane(shown);
  if (domain != desk.domain || is_of_last_file) show(desk, first_quantity(domain));
  desk.domain = domain;
  desk.up = desk.asked_up.value_or(guessed_up(*session.model().mesh, session.model().camera));
  use_scene_camera(desk);
  const auto kept = std::exchange(desk.kept_sight, std::nullopt);
  if (!kept || kept->path != session.model().path) return;
  desk.up = kept->up;
  desk.camera = CameraControl(kept->camera.camera(), session.model().bounds);
}

/// Seconds since some beginning.
double time_now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Takes in what has become of the file that is being written. Whether it is done.
bool update_saving(Desk& desk) {
  const bool is_done = desk.saver.deliver();
  if (const auto error = desk.saver.take_error()) {
    desk.save_error = *error;
    desk.session.tell_error(*error);
    desk.saving.clear();
    return true;
  }
  return is_done;
}

/// Takes in what has been measured. Whether there was anything.
bool update_meter(Desk& desk) {
  bool has_changed = desk.meter.update(desk.session, up_direction(desk.up));
  has_changed |= desk.plan.update(desk.session);
  has_changed |= desk.network.update(desk.session);
  const auto error = desk.meter.take_error();
  if (error) desk.session.tell_error(*error);
  return has_changed || error;
}

/// Keeps what is known of the luminaires in step with the scene.
void follow_scene(Desk& desk) {
  const auto& scene = desk.session.model().scene;
  if (desk.luminaires_of == scene) return;
  desk.luminaires_of = scene;
  desk.luminaires.clear();
  if (scene) desk.luminaires = luminaire_facts(*scene, desk.session.mix());
}

/// Keeps what is marked in the list of surfaces: where the picture was clicked, and in step with
/// other patches.
void update_marks(Desk& desk) {
  const Session& session = desk.session;
  const auto asked = desk.facts ? std::optional(desk.facts->patch) : std::nullopt;
  if (asked != session.selected()) {
    const auto patch = session.selected();
    desk.marks.mark(patch ? std::vector{session.model().mesh->surface[*patch]}
                          : std::vector<std::int32_t>());
  }
  desk.marks.follow(session.model().mesh);
}

}  // namespace

const char* first_quantity(Domain domain) {
  switch (domain) {
    case Domain::heat:
      return "net-flux";
    case Domain::factors:
      return "form-factors";
    case Domain::light:
      break;
  }
  return "true-colour";
}

bool update(Desk& desk) {
  bool has_changed = desk.session.update();
  has_changed |= update_saving(desk);
  has_changed |= desk.examples.update();
  has_changed |= desk.marks.update();
  has_changed |= desk.summer.deliver();
  const Session& session = desk.session;
  if (const IterationRecord* record = session.iteration()) {
    has_changed |= advance(desk.watching, desk.look, *record, time_now());
  } else if (session.is_idle()) {
    desk.watching.is_playing = false;  // nothing will come
  }
  if (session.versions().file != desk.shown_file) {
    greet(desk);
  } else if (desk.facts && !session.selected() &&
             session.versions().model != desk.facts_versions.model) {
    // Divided otherwise: the question is about the same place.
    desk.session.select(same_place(*session.model().mesh, *desk.facts));
  }
  follow_scene(desk);
  const std::string pinned =
      follow_model(desk.pinning, desk.look, session.model(), session.versions().model);
  if (!pinned.empty()) desk.session.tell(pinned);
  has_changed |= update_meter(desk);
  if (desk.asks_light_path) desk.session.ask_light_path();
  const Session::Versions& now = session.versions();
  const Session::Versions& then = desk.facts_versions;
  if (now.light != then.light) {
    desk.fluxes.clear();
    if (session.is_thermal() && session.light() != nullptr) {
      desk.fluxes = radiosity::surface_fluxes(*session.model().mesh, session.light()->solution);
    }
  }
  if (now.selection != then.selection || now.model != then.model) update_marks(desk);
  has_changed |=
      update_asking(session, {desk.facts, desk.emitter_shares, desk.facts_versions, desk.summing});
  return has_changed;
}

void reload(Desk& desk) {
  desk.session.reload();
  desk.kept_sight = {desk.session.model().path, desk.up, desk.camera};
}

void show(Desk& desk, const std::string& name) {
  const auto known = show_named(name);
  if (!known) {
    std::string list;
    for (const ShowName& other : show_names()) {
      list += fmt::format("{}{}", list.empty() ? "" : ", ", other.name);
    }
    throw std::invalid_argument(fmt::format("nothing is called '{}'; there are {}", name, list));
  }
  desk.look.show = known->show;
  if (known->show == Show::quantity) desk.look.quantity = known->quantity;
  desk.look.range.reset();
  desk.look.logarithmic = is_wide(known->show);
  if (known->show == Show::light_path) desk.asks_light_path = true;
  if (known->show == Show::grid) desk.plan.set_wanted(true);
  if (known->show == Show::work_plane && !desk.meter.plane()) {
    desk.meter.set_plane(radiosity::WorkPlaneOptions{});
  }
}

void record_iteration(Desk& desk, radiosity::Method method) {
  desk.session.record_iteration(method);
  if (desk.look.show != Show::unshot) show(desk, "watched");
  desk.look.step = 0;
  desk.watching.method = method;
  desk.watching.is_playing = false;
  // Its first shots, of thousands, are those to learn from.
  desk.watching.is_logarithmic = method == radiosity::Method::southwell;
}

void play_iteration(Desk& desk, double speed) {
  play(desk.watching, desk.look, desk.session.iteration(), speed, time_now());
}

void fit_camera(Desk& desk) {
  if (!desk.session.is_open()) return;
  const radiosity::PatchMesh& mesh = *desk.session.model().mesh;
  desk.camera =
      CameraControl(radiosity::fit_camera(mesh, desk.camera.camera()), desk.session.model().bounds);
}

void use_scene_camera(Desk& desk) {
  if (!desk.session.is_open()) return;
  const Model& model = desk.session.model();
  // A camera with another up would turn about the wrong axis.
  const bool has_camera = model.camera && guessed_up(*model.mesh, model.camera) == desk.up;
  desk.camera = CameraControl(has_camera ? *model.camera : outside_camera(*model.mesh, desk.up),
                              model.bounds);
}

void use_view(Desk& desk, const std::string& name) {
  desk.camera = CameraControl(view_named(desk.views, name).camera, desk.session.model().bounds);
}

void make_lamp(Desk& desk, std::int32_t surface, double lumens) {
  desk.session.make_lamp(surface, lumens);
  desk.is_exposure_due = true;
}

void set_up(Desk& desk, UpAxis up) {
  desk.up = up;
  if (!desk.session.is_open()) return;
  const radiosity::PatchMesh& mesh = *desk.session.model().mesh;
  desk.camera = CameraControl(outside_camera(mesh, up), desk.session.model().bounds);
}

void set_unit(Desk& desk, const std::string& unit) {
  io::metres_per_unit(unit);  // to refuse what is none
  const Model& model = desk.session.model();
  if (!model.scene) throw radiosity::SceneError("a unit can be chosen for scenes only");
  desk.session.open(model.path, unit);
}

radiosity::Camera picture_camera(const Desk& desk) {
  radiosity::Camera camera = desk.camera.camera();
  const bool is_high = desk.region.width > 0 && desk.region.width < desk.region.height;
  if (is_high) {
    const double aspect = static_cast<double>(desk.region.width) / desk.region.height;
    camera.vertical_fov = 2 * std::atan(std::tan(camera.vertical_fov / 2) / aspect);
  }
  return camera;
}

std::optional<radiosity::Hit> hit_at(const Desk& desk, double x, double y) {
  if (!desk.session.is_open() || desk.region.height <= 0) return std::nullopt;
  const Model& model = desk.session.model();
  const double aspect = static_cast<double>(desk.region.width) / desk.region.height;
  const radiosity::Camera camera = picture_camera(desk);
  return first_seen(*model.visibility, *model.mesh, desk.look.hidden, Backs::hidden,
                    camera.position, ray_direction(camera, x, y, aspect));
}

std::optional<Index> patch_at(const Desk& desk, double x, double y) {
  const auto hit = hit_at(desk, x, y);
  if (!hit) return std::nullopt;
  return hit->patch;
}

std::string hovered_text(const Desk& desk) {
  if (desk.hovered_reading) {
    const bool is_grid = desk.look.show == Show::grid;
    const std::string unit =
        is_grid && desk.legend ? desk.legend->unit : (desk.session.is_thermal() ? "W/m²" : "lux");
    const char* what = is_grid ? "grid" : "work plane";
    return fmt::format("{}, {} {}", what, number_text(*desk.hovered_reading), unit);
  }
  if (desk.hovered_luminaire)
    return luminaire_text(desk.luminaires.at(*desk.hovered_luminaire), desk.session.mix());
  if (!desk.hovered || !desk.session.is_open()) return "";
  const radiosity::PatchMesh& mesh = *desk.session.model().mesh;
  const Index patch = *desk.hovered;
  if (patch >= mesh.size()) return "";  // of the scene before
  const std::int32_t index = mesh.surface[static_cast<std::size_t>(patch)];
  const std::string coupled = coupling_text(desk.network.network(), mesh.surface_names, index);
  const std::string& surface =
      mesh.surface_names[index] + (coupled.empty() ? "" : " (" + coupled + ")");
  if (!desk.legend || desk.legend->values.size() != mesh.size()) return surface;
  const int digits = standing(desk.session).is_rough ? kRoughDigits : kDigits;
  const std::string unit = desk.legend->unit.empty() ? "" : " " + desk.legend->unit;
  return fmt::format("{}, {}{}", surface, number_text(desk.legend->values[patch], digits), unit);
}

void set_scale(Desk& desk, double scale) {
  constexpr double kSmallest = 0.5;
  constexpr double kLargest = 4;
  desk.wanted_scale = std::clamp(scale, kSmallest, kLargest);
}

void enlarge(Desk& desk, int quarters) {
  const double now = desk.wanted_scale.value_or(desk.scale);
  set_scale(desk, (std::round(4 * now) + quarters) / 4);
}

void set_console_lines(Desk& desk, int n_lines) {
  constexpr int kMostLines = 60;
  desk.console_lines = std::clamp(n_lines, 1, kMostLines);
}

std::string messages_text(const Session& session) {
  std::string text;
  for (const Message& message : session.messages()) {
    text += (message.is_error ? "error: " : "") + message.text + '\n';
  }
  return text;
}

void check_output(const Desk& desk, const std::string& path) {
  const Model& model = desk.session.model();
  std::vector<std::filesystem::path> inputs = desk.kept_files;
  if (!model.path.empty()) inputs.emplace_back(model.path);
  inputs.emplace_back(desk.session.asked_path());
  if (model.scene) {
    inputs.insert(inputs.end(), model.scene->files.begin(), model.scene->files.end());
  }
  io::check_not_input(path, inputs);
}

namespace {

void check_result(const Desk& desk, const std::string& path) {
  if (desk.session.light() == nullptr) {
    throw radiosity::OutputError("there is no light yet that could be saved");
  }
  if (!desk.session.has_result()) {
    throw radiosity::OutputError(
        path +
        ": not saved: the light that is shown is a preview, or its errors are still being "
        "found; it can be saved once it is solved");
  }
  check_output(desk, path);
}

void write_result(const Known& known, const radiosity::Camera& camera, const std::string& path) {
  io::write(path, *known.model.mesh, known.light->solution,
            {.bands = known.model.bands, .quantities = {}, .camera = camera});
}

}  // namespace

void save_result(const Desk& desk, const std::string& path) {
  check_result(desk, path);
  write_result(desk.session.known(), desk.camera.camera(), path);
}

void begin_save_result(Desk& desk, const std::string& path) {
  check_result(desk, path);
  if (!desk.saving.empty()) {
    throw radiosity::OutputError(path + ": not saved: " + desk.saving + " is still being written");
  }
  desk.saving = path;
  desk.save_error.reset();
  desk.saver.start([&desk, path, known = desk.session.known(),
                    camera = desk.camera.camera()](const Worker::Context& context) {
    write_result(known, camera, path);
    context.post([&desk, path] {
      desk.session.tell("saved " + path);
      desk.saving.clear();
    });
  });
}

void save_scene(const Desk& desk, const std::string& path) {
  if (!desk.session.model().scene) {
    throw radiosity::OutputError("there is no scene that could be saved");
  }
  check_output(desk, path);
  radiosity::Scene scene = mixed_scene(*desk.session.model().scene, desk.session.mix());
  scene.camera = desk.camera.camera();
  scene.views = desk.views;
  io::write_scene(path, scene);
}

}  // namespace viewer
