// What a person asks of an open scene: patches, light paths, iterations.
#include <fmt/format.h>

#include <chrono>
#include <stdexcept>
#include <utility>

#include "radiosity/scene/radiometry.h"
#include "radiosity/solve/conditions.h"
#include "radiosity/solve/importance.h"
#include "radiosity/solve/solve.h"
#include "viewer/work/pipeline.h"
#include "viewer/work/session.h"

namespace viewer {

using radiosity::Index;
using radiosity::Scene;

void Session::select(std::optional<Index> patch) {
  if (patch && (!model_.mesh || *patch < 0 || *patch >= model_.mesh->size())) {
    throw std::out_of_range(fmt::format("there is no patch {}; the scene has {}", *patch,
                                        model_.mesh ? model_.mesh->size() : 0));
  }
  if (patch == selected_) return;
  selected_ = patch;
  find_row();
  forget_light_path();
  ++versions_.selection;
}

/// Where a row takes a product, or is long, in the background.
void Session::find_row() {
  row_.reset();
  rows_.cancel();
  if (!selected_ || !model_.factors) return;
  // HDF5 is for one thread, and a file's rows are asked one by one.
  const bool is_long = model_.transport && is_large();
  if (model_.has_quick_rows && !is_long) {
    row_ = std::make_shared<const FactorRow>(
        make_factor_row(*model_.factors, model_.mesh->area, *selected_));
    return;
  }
  rows_.start([this, model = model_, patch = *selected_](const Worker::Context& context) {
    auto row =
        std::make_shared<const FactorRow>(make_factor_row(*model.factors, model.mesh->area, patch));
    context.post([this, row] {
      row_ = row;
      ++versions_.selection;
    });
  });
}

void Session::ask_light_path() {
  if (!selected_ || !model_.transport || has_asked_) return;
  has_asked_ = true;
  asking_.start(
      [this, model = model_, mix = mix_, patch = *selected_](const Worker::Context& context) {
        const Scene scene = with_reflectance(*model.scene, mix);
        radiosity::SolveOptions options;
        options.estimates_errors = false;
        options.progress = context.progress;
        auto path = std::make_shared<LightPath>();
        path->patch = patch;
        path->importance = radiosity::importance(
            *model.transport, radiosity::reflectance(scene, *model.mesh), patch, options);
        context.post([this, path] {
          light_path_ = path;
          ++versions_.selection;
        });
      });
}

void Session::forget_light_path() {
  light_path_.reset();
  has_asked_ = false;
  asking_.cancel();
}

/// Of the record that makes room for one by another method, as long as it is of the same light.
void Session::keep_curve(radiosity::Method next) {
  if (is_iteration_stale()) {
    compared_.clear();
    return;
  }
  if (iteration_ && !iteration_->work.empty()) {
    auto curve = std::make_shared<IterationRecord>(*iteration_);
    curve->frames.clear();
    compared_.push_back(std::move(curve));
  }
  std::erase_if(compared_, [&](const auto& record) { return record->method == next; });
}

void Session::record_iteration(radiosity::Method method) {
  if (!model_.transport) {
    tell_error("iterations can be watched once the form factors are known");
    return;
  }
  keep_curve(method);
  iteration_.reset();
  iteration_mix_ = versions_.mix;
  ++versions_.iteration;
  recording_.start([this, method, now = model_, mix = mix_](const Worker::Context& context) {
    const Model model = below_sky(now, mix, context.progress);
    const Scene scene = with_reflectance(*model.scene, mix);
    radiosity::Conditions conditions =
        make_conditions(scene, *model.mesh, *model.transport, outer_irradiance(model, mix));
    conditions.exitance = mix_exitance(scene, *model.mesh, mix);
    IterationRecorder recorder(
        method, model.transport->area(),
        radiosity::initial_radiosity(conditions.exitance.cwiseAbs(), conditions.reflectance,
                                     conditions.incident));
    const auto show = [&] {
      context.post([this, record = std::make_shared<const IterationRecord>(recorder.record())] {
        iteration_ = record;
        ++versions_.iteration;
      });
    };
    constexpr auto kInterval = std::chrono::milliseconds(200);
    auto shown = Clock::now();
    radiosity::SolveOptions options = with_conditions({}, conditions, scene.bands.count());
    options.method = method;
    options.tolerance = 1e-6;
    options.max_products = 5000;
    options.estimates_errors = false;
    options.progress = context.progress;
    options.on_step = [&](const radiosity::SolveStep& step) {
      recorder.add(step);
      if (Clock::now() - shown < kInterval) return;
      show();
      shown = Clock::now();
    };
    recorder.finish(solve(*model.transport, conditions.exitance, conditions.reflectance, options));
    show();
  });
}

void Session::forget_iteration() {
  recording_.cancel();
  iteration_.reset();
  compared_.clear();
  ++versions_.iteration;
}

}  // namespace viewer
