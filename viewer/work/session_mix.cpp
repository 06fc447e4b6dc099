// What a person changes about an open scene's light.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <utility>

#include "radiosity/base/error.h"
#include "viewer/work/lamp.h"
#include "viewer/work/session.h"

namespace viewer {

using Item = MixHistory::Item;

namespace {

/// Undims what a surface belongs to.
void light_fully(std::int32_t surface, LightMix& mix) {
  for (Emitter& emitter : mix.emitters) {
    if (std::find(emitter.surfaces.begin(), emitter.surfaces.end(), surface) ==
        emitter.surfaces.end()) {
      continue;
    }
    emitter.scale = 1;
    emitter.is_on = true;
  }
}

/// A mix as another one is as far as they have emitters and materials in common.
LightMix with_choices_of(LightMix mix, const LightMix& other) {
  mix.sun = other.sun;
  mix.sky = other.sky;
  for (Emitter& emitter : mix.emitters) {
    for (const Emitter& like : other.emitters) {
      if (like.kind != emitter.kind || like.name != emitter.name) continue;
      emitter.scale = like.scale;
      emitter.is_on = like.is_on;
    }
  }
  const std::size_t n = std::min(mix.reflectance.size(), other.reflectance.size());
  for (std::size_t m = 0; m < n; ++m) mix.reflectance[m] = other.reflectance[m];
  return mix;
}

}  // namespace

void Session::set_emitter(std::size_t emitter, double scale, bool is_on) {
  const Emitter& now = mix_.emitters.at(emitter);
  if (!(scale >= 0) || !std::isfinite(scale)) {
    throw std::out_of_range(fmt::format("an emitter's scale must be at least 0, found {}", scale));
  }
  if (now.scale == scale && now.is_on == is_on) return;
  mix_history_.note({.kind = Item::Kind::emitter, .index = emitter}, mix_);
  LightMix mix = mix_;
  mix.emitters[emitter].scale = scale;
  mix.emitters[emitter].is_on = is_on;
  take_mix(std::move(mix));
}

void Session::set_reflectance(std::size_t material, const Eigen::VectorXd& reflectance) {
  const Eigen::VectorXd& now = mix_.reflectance.at(material);
  if (reflectance.size() != now.size()) {
    throw std::out_of_range(fmt::format("expected {} reflectances, one for each band, found {}",
                                        now.size(), reflectance.size()));
  }
  for (const double value : reflectance) {
    if (!(value >= 0 && value <= 1)) {
      throw std::out_of_range(fmt::format("a reflectance must be in [0, 1], found {}", value));
    }
  }
  if (now == reflectance) return;
  mix_history_.note({.kind = Item::Kind::material, .index = material}, mix_);
  LightMix mix = mix_;
  mix.reflectance[material] = reflectance;
  take_mix(std::move(mix));
}

void Session::set_daylight(const std::optional<radiosity::Sun>& sun,
                           const std::optional<radiosity::Sky>& sky) {
  if (sun.has_value() != mix_.sun.has_value() || sky.has_value() != mix_.sky.has_value()) {
    throw std::invalid_argument("sun and sky can be changed, not added or taken away");
  }
  LightMix mix = mix_;
  mix.sun = sun;
  mix.sky = sky;
  // Of a sky that does not depend on the sun it is kept all the same, for others that do.
  const bool is_same_place = !sky || sky->towards_sun == mix_.sky->towards_sun;
  if (mix.has_daylight_of(mix_) && is_same_place) return;
  mix_history_.note({.kind = Item::Kind::daylight}, mix_);
  take_mix(std::move(mix));
}

void Session::reset_daylight() {
  mix_history_.begin_step();
  set_daylight(original_mix_.sun, original_mix_.sky);
}

void Session::make_lamp(std::int32_t surface, double lumens) {
  if (!model_.scene) throw radiosity::SceneError("only a surface of a scene can be made a lamp");
  auto scene = std::make_shared<const radiosity::Scene>(with_lamp(*model_.scene, surface, lumens));
  LightMix mix = with_choices_of(make_mix(*scene), mix_);
  mix.reflectance.back() = mix_.reflectance[model_.scene->surfaces[surface].material];
  original_mix_ = with_choices_of(make_mix(*scene), original_mix_);
  for (LightMix* of : {&mix, &original_mix_}) light_fully(surface, *of);
  mix_ = std::move(mix);
  model_.scene = std::move(scene);
  model_.outer.reset();  // which goes by the emitters
  mix_history_.clear();
  emitter_lights_.reset();
  forget_light_path();
  forget_iteration();
  previewing_.cancel();
  lighting_.cancel();
  light_.reset();
  is_quick_running_ = false;
  ++versions_.light;
  // A compressed operator is made for the light that there was.
  const bool is_usable = model_.transport && !model_.transport->report().compression;
  if (is_usable) {
    relight();
  } else {
    ++versions_.mix;
    restart(options_);
  }
}

void Session::reset_emitter(std::size_t emitter) {
  const Emitter& original = original_mix_.emitters.at(emitter);
  mix_history_.begin_step();
  set_emitter(emitter, original.scale, original.is_on);
}

void Session::reset_material(std::size_t material) {
  mix_history_.begin_step();
  set_reflectance(material, original_mix_.reflectance.at(material));
}

void Session::reset_mix() {
  mix_history_.begin_step();
  mix_history_.note({}, mix_);
  take_mix(original_mix_);
}

void Session::undo_mix() {
  if (mix_history_.can_undo()) take_mix(mix_history_.undo(mix_));
}

void Session::redo_mix() {
  if (mix_history_.can_redo()) take_mix(mix_history_.redo(mix_));
}

void Session::take_mix(LightMix mix) {
  const bool has_same_paint = mix_.has_reflectance_of(mix);
  if (!has_same_paint || !mix_.has_daylight_of(mix)) emitter_lights_.reset();
  if (!has_same_paint) forget_light_path();
  mix_ = std::move(mix);
  relight();
}

}  // namespace viewer
