#include "viewer/work/session.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <utility>

#include "radiosity/base/error.h"
#include "radiosity/scene/radiometry.h"
#include "radiosity/solve/solution.h"
#include "radiosity/solve/solve.h"
#include "radiosity/solve/surface_flux.h"
#include "study/warnings.h"
#include "viewer/work/pipeline.h"
#include "viewer/work/preview.h"

namespace viewer {
namespace {

using radiosity::Index;
using radiosity::Scene;

constexpr std::size_t kMostMessages = 200;

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// A callback for a worker's thread: what it is told is delivered to `take` on the window's thread.
template <typename... Arguments, typename Take>
std::function<void(Arguments...)> posting(const Worker::Context& context, Take take) {
  return [context, take](Arguments... arguments) {
    // Shared, since std::function wants to copy what it holds.
    auto kept = std::make_shared<std::tuple<std::decay_t<Arguments>...>>(std::move(arguments)...);
    context.post([take, kept] { std::apply(take, std::move(*kept)); });
  };
}

}  // namespace

Session::Session(study::StudyOptions options, io::ReadOptions reading)
    : options_(std::move(options)),
      reading_(std::move(reading)),
      pipeline_(&pause_),
      previewing_(&pause_),
      lighting_(&pause_),
      recording_(&pause_) {}

void Session::open(const std::string& path, const std::optional<std::string>& unit) {
  asked_path_ = path;
  refusal_.reset();
  opening_.start([this, path, unit, options = options_, reading = reading_,
                  start = Clock::now()](const Worker::Context& context) mutable {
    OpenedFile file;
    // What is written while it is read is not what was read.
    std::vector<FileStamp> stamps = file_stamps({path});
    if (is_result_file(path)) {
      file = open_result(path);
    } else {
      if (unit) reading.unit = unit;
      auto scene = std::make_shared<const Scene>(read_whole_scene(path, reading, context.progress));
      for (FileStamp& stamp : file_stamps(scene->files)) {
        if (stamp.path != path) stamps.push_back(std::move(stamp));
      }
      file = open_scene(path, std::move(scene), options, context.progress);
      file.model.unit = reading.unit;
    }
    posting<OpenedFile>(context, [this, start, stamps](OpenedFile opened) {
      ++versions_.file;
      file_watch_.watch(stamps);
      for (Message& message : messages_) message.is_past = true;
      take_file(std::move(opened), start);
    })(std::move(file));
  });
}

void Session::reload() {
  if (!is_open()) throw radiosity::SceneError("there is no file to be opened again");
  std::vector<std::filesystem::path> files = {model_.path};
  if (model_.scene)
    files.insert(files.end(), model_.scene->files.begin(), model_.scene->files.end());
  file_watch_.watch(file_stamps(files));
  open(model_.path, model_.unit);
}

void Session::restart(const study::StudyOptions& options) {
  if (!model_.scene) {
    options_ = options;
    tell_error("only a scene can be solved again; a result file holds its result alone");
    return;
  }
  refusal_.reset();
  opening_.start([this, options, path = model_.path, scene = model_.scene, unit = model_.unit,
                  start = Clock::now()](const Worker::Context& context) {
    OpenedFile file = open_scene(path, scene, options, context.progress);
    file.model.unit = unit;
    posting<OpenedFile>(context, [this, options, start](OpenedFile opened) {
      if (opened.refusal) {  // what is open is worth more than its polygons
        refusal_ = opened.refusal;
        tell_error(*opened.refusal);
        return;
      }
      options_ = options;
      take_file(std::move(opened), start);
    })(std::move(file));
  });
}

void Session::take_file(OpenedFile file, Clock::time_point start) {
  if (pipeline_.is_busy() || lighting_.is_busy()) job_ = {};  // that of the file before
  job_.set_rounds(options_.patches.adaptive);
  cancel_computing();
  pause_.set(false);
  start_ = start;
  take_model(std::move(file.model));
  for (const std::string& warning : file.warnings) tell(warning);
  if (file.refusal) {
    tell_error(*file.refusal);
  } else if (file.light) {
    take_light(*std::move(file.light), {});
  } else if (model_.scene) {
    if (!mix_.emitters.empty()) start_preview();
    start_form_factors();
  }
}

/// By rough form factors once there are some, before by shooting.
void Session::start_preview() {
  is_quick_running_ = true;
  is_relight_due_ = false;
  if (!rough_) {
    start_shooting();
    return;
  }
  Eigen::MatrixXd irradiance;
  if (light_ && light_->factor_error) irradiance = light_->solution.irradiance;
  previewing_.start([this, model = model_, rough = rough_, mix = mix_,
                     irradiance = std::move(irradiance)](const Worker::Context& context) {
    posting<Light>(context, [this, mix](Light light) { take_light(std::move(light), mix); })(
        rough_light(model, *rough, mix, irradiance, context.progress));
  });
}

void Session::start_shooting() {
  previewing_.start([this, model = model_, mix = mix_](const Worker::Context& context) {
    preview(model, mix,
            posting<radiosity::Solution, std::shared_ptr<const OuterLight>, double>(
                context,
                [this, mix](radiosity::Solution solution, std::shared_ptr<const OuterLight> outer,
                            double unshot) {
                  unshot_share_ = unshot;
                  take_light({.kind = Light::Kind::preview,
                              .solution = std::move(solution),
                              .outer = std::move(outer)},
                             mix);
                }),
            context.progress);
  });
}

void Session::start_form_factors() {
  pipeline_.start([this, model = model_, options = options_](const Worker::Context& context) {
    const FormFactorEvents events = {
        .warned =
            posting<const std::string&>(context, [this](const std::string& text) { tell(text); }),
        .rough = posting<std::shared_ptr<const radiosity::Transport>>(
            context, [this](std::shared_ptr<const radiosity::Transport> rough) {
              take_rough(std::move(rough));
            })};
    posting<Model>(context, [this](Model found) { take_model(std::move(found)); })(
        with_form_factors(model, options, events, context.progress));
  });
}

void Session::take_rough(std::shared_ptr<const radiosity::Transport> rough) {
  rough_ = std::move(rough);
  if (!mix_.emitters.empty()) start_preview();
}

void Session::cancel_computing() {
  for (Worker* worker : {&pipeline_, &previewing_, &lighting_, &recording_}) worker->cancel();
}

void Session::stop() {
  pause_.set(false);
  opening_.cancel();
  cancel_computing();
  tell("stopped");
}

void Session::take_model(Model model) {
  const bool is_other_mesh = model.mesh != model_.mesh;
  const bool is_other_scene = model.scene != model_.scene || model.scene == nullptr;
  model_ = std::move(model);
  ++versions_.model;
  rough_.reset();
  if (is_other_mesh) {
    previewing_.cancel();
    lighting_.cancel();
    forget_light_path();
    light_.reset();
    changed_.reset();
    emitter_lights_.reset();
    seconds_to_solve_ = 0;
    select(std::nullopt);
    forget_iteration();
    ++versions_.light;
  }
  if (is_other_scene && is_other_mesh) {
    mix_ = model_.scene ? make_mix(*model_.scene) : LightMix{};
    original_mix_ = mix_;
    mix_history_.clear();
    ++versions_.mix;
  }
  find_row();
  if (is_relight_due_ && previewing_.is_busy()) start_preview();
  if (model_.transport) {
    mark_openings();
    start_light_task();
  }
}

/// Finds what has been said of them.
void Session::mark_openings() {
  const auto warning = study::open_rows_warning(model_.transport->report());
  if (!warning) return;
  for (Message& message : messages_) {
    message.is_about_openings |= !message.is_past && message.text == *warning;
  }
}

void Session::take_light(Light light, const std::optional<LightMix>& mix) {
  if (mix) light.mix = std::make_shared<const LightMix>(*mix);
  if (light.outer) model_.outer = light.outer;  // the next one need not find it again
  if (light.kind != Light::Kind::preview) previewing_.cancel();
  const bool is_first = light.kind == Light::Kind::solved && seconds_to_solve_ == 0;
  if (is_first) seconds_to_solve_ = seconds_since(start_);
  const bool is_quick = light.kind != Light::Kind::preview || !model_.transport;
  if (changed_ && !is_relight_due_) {
    change_seconds_ = seconds_since(*changed_);
    changed_.reset();
  }
  light_ = std::make_shared<const Light>(std::move(light));
  ++versions_.light;
  if (is_quick) {
    is_quick_running_ = false;
    if (std::exchange(is_relight_due_, false)) relight_anew();
  }
}

void Session::start_light_task() {
  LightStart start;
  const bool has_light = light_ && light_->kind != Light::Kind::preview;
  if (has_light) start.irradiance = light_->solution.irradiance;
  start.tolerance = study::iteration_tolerance(options_.tolerance);
  start.is_separation_wanted = emitter_lights_ == nullptr;
  start.is_quick_wanted = has_light && start.is_separation_wanted;
  if (is_large()) start.separated = emitter_lights_;
  is_quick_running_ = start.is_quick_wanted || start.separated;
  is_relight_due_ = false;
  lighting_.start([this, model = model_, mix = mix_, start](const Worker::Context& context) {
    const LightEvents events = {
        .lit = posting<Light>(context,
                              [this, mix](Light light) { take_light(std::move(light), mix); }),
        .separated = posting<EmitterLights>(
            context,
            [this](EmitterLights lights) {
              emitter_lights_ = std::make_shared<const EmitterLights>(std::move(lights));
            }),
        .warned = posting<const std::string&>(
            context, [this](const std::string& text) { tell_once(text); })};
    solve_light(model, mix, start, events, context.progress);
  });
}

void Session::relight() {
  ++versions_.mix;
  changed_ = Clock::now();
  change_seconds_ = 0;
  const Worker& worker = model_.transport ? lighting_ : previewing_;
  if (emitter_lights_ && !is_large()) {
    take_light({Light::Kind::solved, superpose(*emitter_lights_, mix_)}, mix_);
    start_light_task();
  } else if (is_quick_running_ && worker.is_busy()) {
    // Let it finish, else the picture would never follow a slider that keeps moving.
    is_relight_due_ = true;
  } else {
    relight_anew();
  }
}

bool Session::is_large() const { return model_.mesh && model_.mesh->size() > kManyPatches; }

void Session::relight_anew() {
  // Until there are form factors, and until they have been used, there is a preview.
  const bool is_previewed = !model_.transport && (light_ || pipeline_.is_busy());
  if (is_previewed || previewing_.is_busy()) start_preview();
  if (model_.transport) start_light_task();
}

bool Session::update() {
  bool has_changed = false;
  for (Worker* worker :
       {&opening_, &pipeline_, &previewing_, &lighting_, &asking_, &rows_, &recording_}) {
    has_changed |= worker->deliver();
    if (const auto error = worker->take_error()) {
      tell_error(*error);
      has_changed = true;
    }
  }
  if (file_watch_.update()) {
    tell(changed_file()->string() + " has changed on disk since it was read");
    messages_.back().is_about_file = true;
    has_changed = true;
  }
  // Between two stages of a job nothing is busy, but what the first one found is not taken yet.
  const WorkStatus now = status();
  if (now.is_busy || is_idle()) job_.update(now, seconds_since(created_));
  return has_changed;
}

bool Session::is_settled() const {
  return !opening_.is_busy() && !pipeline_.is_busy() && !lighting_.is_busy();
}

bool Session::is_idle() const {
  return is_settled() && !previewing_.is_busy() && !asking_.is_busy() && !rows_.is_busy() &&
         !recording_.is_busy();
}

WorkStatus Session::status() const {
  for (const Worker* worker :
       {&pipeline_, &lighting_, &opening_, &recording_, &asking_, &rows_, &previewing_}) {
    WorkStatus status = worker->status();
    if (status.is_busy) return status;
  }
  return {};
}

bool Session::is_thermal() const { return model_.scene && radiosity::is_thermal(*model_.scene); }

void Session::add_message(bool is_error, const std::string& text) {
  messages_.push_back({.is_error = is_error, .text = text});
  if (messages_.size() > kMostMessages) messages_.pop_front();
  ++versions_.messages;
}

void Session::tell_once(const std::string& text) {
  const bool is_told = std::any_of(messages_.begin(), messages_.end(), [&](const Message& message) {
    return !message.is_past && message.text == text;
  });
  if (!is_told) tell(text);
}

void Session::clear_messages() {
  messages_.clear();
  ++versions_.messages;
}

bool is_solved(const Session& session) {
  if (!session.is_open()) return false;
  if (!session.model().scene) return true;  // nothing to solve
  return session.light() != nullptr && session.light()->has_errors();
}

}  // namespace viewer
