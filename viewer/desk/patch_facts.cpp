#include "viewer/desk/patch_facts.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "radiosity/solve/quantity.h"
#include "radiosity/solve/solution.h"

namespace viewer {
namespace {

using radiosity::Index;

constexpr std::size_t kMostPartners = 10;
constexpr Index kMostNumbers = 4;

std::vector<Partner> largest(const Eigen::VectorXd& row, const Eigen::VectorXd& error) {
  std::vector<Index> order(static_cast<std::size_t>(row.size()));
  std::iota(order.begin(), order.end(), Index{0});
  const std::size_t n = std::min(kMostPartners, order.size());
  const auto middle = order.begin() + static_cast<std::ptrdiff_t>(n);
  std::partial_sort(order.begin(), middle, order.end(),
                    [&](Index a, Index b) { return row[a] != row[b] ? row[a] > row[b] : a < b; });
  std::vector<Partner> partners;
  for (std::size_t k = 0; k < n && row[order[k]] > 0; ++k) {
    partners.push_back({order[k], row[order[k]], error[order[k]]});
  }
  return partners;
}

void add_light(PatchFacts& facts, const Session& session) {
  const radiosity::Solution& solution = session.light()->solution;
  facts.has_light = true;
  facts.radiosity = solution.radiosity.row(facts.patch);
  facts.irradiance = solution.irradiance.row(facts.patch);
  facts.exitance = solution.exitance.row(facts.patch);
  facts.reflectance = solution.reflectance.row(facts.patch);
  if (session.light()->has_errors()) facts.error = solution.radiosity_error.row(facts.patch);
  const Eigen::VectorXd weights = radiosity::luminous_weights(session.model().bands);
  facts.illuminance = weights.dot(facts.irradiance);
  facts.luminance = weights.dot(facts.radiosity) / radiosity::kPi;
}

}  // namespace

PatchFacts patch_facts(const Session& session) {
  const Model& model = session.model();
  PatchFacts facts;
  facts.patch = session.selected().value();
  const auto i = static_cast<std::size_t>(facts.patch);
  const std::int32_t surface = model.mesh->surface[i];
  facts.surface = model.mesh->surface_names[surface];
  if (model.scene) {
    facts.material = model.scene->materials[model.scene->surfaces[surface].material].name;
  }
  facts.polygon = model.mesh->polygon[i];
  facts.area = model.mesh->area[i];
  facts.centroid = model.mesh->centroid[i];
  facts.normal = model.mesh->normal[i];
  if (session.light() != nullptr) add_light(facts, session);
  if (!model.factors) return facts;
  const Eigen::VectorXd row = model.factors->row(facts.patch);
  facts.has_factors = true;
  facts.partners = largest(row, model.factors->row_error(facts.patch));
  facts.row_sum = row.sum();
  if (facts.has_light) facts.direct = session.light()->solution.exitance.transpose() * row;
  return facts;
}

std::string numbers_text(const Eigen::VectorXd& values) {
  std::string text;
  for (Index k = 0; k < std::min(values.size(), kMostNumbers); ++k) {
    text += fmt::format("{}{:.3g}", k > 0 ? "  " : "", values[k]);
  }
  if (values.size() > kMostNumbers) text += fmt::format("  … ({} bands)", values.size());
  return text;
}

}  // namespace viewer
