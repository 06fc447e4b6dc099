// What a person changes about an open scene's light.
#include <fmt/format.h>

#include <cmath>
#include <stdexcept>
#include <utility>

#include "viewer/work/session.h"

namespace viewer {

using Item = MixHistory::Item;

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
  if (mix.has_daylight_of(mix_)) return;
  mix_history_.note({.kind = Item::Kind::daylight}, mix_);
  take_mix(std::move(mix));
}

void Session::reset_daylight() {
  mix_history_.begin_step();
  set_daylight(original_mix_.sun, original_mix_.sky);
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
