#include "viewer/desk/comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace viewer {
namespace {

using radiosity::Quantity;

struct ComparisonName {
  const char* name;
  Comparison comparison;
};
constexpr std::array kComparisons = {ComparisonName{"none", Comparison::none},
                                     ComparisonName{"wipe", Comparison::wipe},
                                     ComparisonName{"difference", Comparison::difference}};

constexpr double kNoChange = 1e-3;  // of the greatest value: what nobody sees

bool is_too_many(const Model& model) { return model.mesh->size() > kMostBeside; }

}  // namespace

std::string comparison_name(Comparison comparison) {
  for (const ComparisonName& known : kComparisons) {
    if (known.comparison == comparison) return known.name;
  }
  return "";
}

std::optional<Comparison> comparison_named(const std::string& name) {
  for (const ComparisonName& known : kComparisons) {
    if (known.name == name) return known.comparison;
  }
  return std::nullopt;
}

bool has_same_patches(const radiosity::PatchMesh& a, const radiosity::PatchMesh& b) {
  return &a == &b || (a.corners == b.corners && a.vertices == b.vertices &&
                      a.surface_names == b.surface_names && a.surface == b.surface);
}

std::string comparison_refusal(const Pinning& pinning, const Model& now, Comparison comparison) {
  if (comparison == Comparison::none) return "";
  if (!pinning.light) return "no light is pinned";
  const Model& then = pinning.light->known.model;
  if (comparison == Comparison::difference && !pinning.has_same_patches) {
    return fmt::format("there is no difference: the pinned light is of other patches ({}, now {})",
                       then.mesh->size(), now.mesh->size());
  }
  if (comparison == Comparison::wipe && (is_too_many(now) || is_too_many(then))) {
    return fmt::format("beyond {} patches there is only the difference", kMostBeside);
  }
  return "";
}

std::string follow_model(Pinning& pinning, Look& look, const Model& now, int version) {
  if (!pinning.light || pinning.model == version) return "";
  pinning.model = version;
  const Model& then = pinning.light->known.model;
  const bool had_patches = pinning.has_same_patches;
  pinning.has_same_patches =
      now.bands.count() == then.bands.count() && has_same_patches(*now.mesh, *then.mesh);
  if (pinning.has_same_patches) return "";
  const bool was_difference = look.comparison == Comparison::difference;
  if (was_difference) look.range.reset();
  const bool is_of_this_scene = now.scene && now.scene == then.scene;
  if (!is_of_this_scene) {
    const std::string path = then.path;
    pinning.light.reset();
    look.comparison = Comparison::none;
    return "the pinned light was of " + path + " and is given up";
  }
  if (was_difference) look.comparison = Comparison::wipe;
  if (!comparison_refusal(pinning, now, look.comparison).empty())
    look.comparison = Comparison::none;
  return had_patches ? comparison_refusal(pinning, now, Comparison::difference) : "";
}

Known with_form_factors_of(const Model& now, Known before) {
  before.model.transport = now.transport;
  before.model.factors = now.factors;
  return before;
}

bool is_comparable(const Look& look) {
  switch (look.show) {
    case Show::true_color:
    case Show::quantity:
    case Show::direct:
    case Show::indirect:
      return true;
    case Show::area:
    case Show::unseen:
    case Show::work_plane:
    case Show::grid:
    case Show::form_factors:
    case Show::arriving:
    case Show::light_path:
    case Show::watched:
    case Show::unshot:
      return false;
  }
  return false;
}

std::optional<ShownField> shown_difference(const Known& now, const Known& before,
                                           const Look& look) {
  if (!is_comparable(look)) return std::nullopt;
  Look compared = look;
  if (look.show == Show::true_color) {
    compared.show = Show::quantity;
    compared.quantity = Quantity::luminance;
  }
  auto field = shown_field(now, compared);
  const auto pinned = shown_field(with_form_factors_of(now.model, before), compared);
  if (!field || !pinned || field->values.size() != pinned->values.size()) return std::nullopt;
  const double greatest =
      std::max(field->values.cwiseAbs().maxCoeff(), pinned->values.cwiseAbs().maxCoeff());
  field->values -= pinned->values;
  field->least_range = kNoChange * greatest;
  field->title.insert(field->title.begin(), "now minus pinned:");
  return field;
}

io::ColorScale difference_scale(const Look& look, const ShownField& differences) {
  if (look.range) {
    const double most = std::max(std::abs(look.range->low), std::abs(look.range->high));
    return {.low = -most, .high = most};
  }
  const Eigen::VectorXd least = Eigen::VectorXd::Constant(1, differences.least_range);
  const double most = std::max(io::fitting_scale(differences.values.cwiseAbs(), false).high,
                               io::fitting_scale(least, false).high);
  return {.low = -most, .high = most};
}

}  // namespace viewer
