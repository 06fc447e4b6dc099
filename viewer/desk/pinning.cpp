#include "viewer/desk/pinning.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "viewer/work/standing.h"

namespace viewer {
namespace {

constexpr double kLeastShare = 0.02;  // of the picture's width on either side of the line

}  // namespace

void pin(Desk& desk) {
  const Session& session = desk.session;
  if (session.light() == nullptr) throw std::runtime_error("there is no light yet to be pinned");
  Pinned pinned{.known = {}, .standing = standing(session).text};
  Model& model = pinned.known.model;
  model = session.model();
  model.transport.reset();
  model.factors.reset();
  model.visibility.reset();
  pinned.known.light = session.known().light;
  desk.pinning.light = std::make_shared<const Pinned>(std::move(pinned));
  desk.pinning.has_same_patches = true;
  desk.pinning.model = session.versions().model;
}

void unpin(Desk& desk) {
  compare(desk, Comparison::none);
  desk.pinning.light.reset();
}

std::string comparison_refusal(const Desk& desk, Comparison comparison) {
  return comparison_refusal(desk.pinning, desk.session.model(), comparison);
}

void compare(Desk& desk, Comparison comparison) {
  const std::string refusal = comparison_refusal(desk, comparison);
  if (!refusal.empty()) throw std::runtime_error(refusal);
  const bool was_difference = desk.look.comparison == Comparison::difference;
  if (was_difference != (comparison == Comparison::difference)) desk.look.range.reset();
  desk.look.comparison = comparison;
}

void compare_otherwise(Desk& desk) {
  const auto after = [](Comparison comparison) {
    if (comparison == Comparison::none) return Comparison::wipe;
    return comparison == Comparison::wipe ? Comparison::difference : Comparison::none;
  };
  Comparison next = after(desk.look.comparison);
  while (!comparison_refusal(desk, next).empty()) next = after(next);
  compare(desk, next);
}

void set_split(Desk& desk, double split) {
  desk.pinning.split = std::clamp(split, kLeastShare, 1 - kLeastShare);
}

Comparison shown_comparison(const Desk& desk) {
  const bool can_be = is_comparable(desk.look) && desk.session.is_open() &&
                      comparison_refusal(desk, desk.look.comparison).empty();
  return can_be ? desk.look.comparison : Comparison::none;
}

std::shared_ptr<const Pinned> subtracted_light(const Desk& desk) {
  return shown_comparison(desk) == Comparison::difference ? desk.pinning.light : nullptr;
}

std::optional<Eigen::VectorXd> pinned_irradiance(const Desk& desk) {
  const Pinning& pinning = desk.pinning;
  const auto patch = desk.session.selected();
  if (!patch || !pinning.light || !pinning.has_same_patches) return std::nullopt;
  return pinning.light->known.light->solution.irradiance.row(*patch);
}

}  // namespace viewer
