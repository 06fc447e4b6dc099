#include "viewer/desk/patch_facts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "radiosity/solve/quantity.h"
#include "radiosity/solve/solution.h"
#include "viewer/desk/surface_totals.h"

namespace viewer {
namespace {

using radiosity::Index;

constexpr Index kMostNumbers = 4;
constexpr int kDigitsOfMany = 3;  // so that they fit into a line

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
    facts.temperature = surface_temperature(session, surface);
  }
  facts.polygon = model.mesh->polygon[i];
  facts.area = model.mesh->area[i];
  facts.centroid = model.mesh->centroid[i];
  facts.normal = model.mesh->normal[i];
  if (session.light() != nullptr) add_light(facts, session);
  if (session.row() == nullptr) return facts;
  facts.has_factors = true;
  facts.partners = session.row()->partners;
  facts.row_sum = session.row()->sum;
  return facts;
}

std::optional<Index> same_place(const radiosity::PatchMesh& mesh, const PatchFacts& facts) {
  std::optional<Index> nearest;
  double least = std::numeric_limits<double>::infinity();
  for (Index i = 0; i < mesh.size(); ++i) {
    if (mesh.polygon[i] != facts.polygon || mesh.normal[i].dot(facts.normal) <= 0) continue;
    const double distance = (mesh.centroid[i] - facts.centroid).norm();
    if (distance >= least) continue;
    least = distance;
    nearest = i;
  }
  return nearest;
}

std::string number_text(double value, int digits) {
  if (value == 0) return "0";
  // Neither 1.641e+04 nor digits that mean nothing.
  const double size = std::abs(value);
  if (size >= 1e6 || size < 1e-3) return fmt::format("{:.{}g}", value, digits);
  const int before = static_cast<int>(std::floor(std::log10(size))) + 1;  // the decimal point
  if (before <= digits) return fmt::format("{:.{}f}", value, digits - before);
  const double unit = std::pow(10, before - digits);
  return fmt::format("{:.0f}", unit * std::round(value / unit));
}

namespace {

std::string numbers_text(const Eigen::VectorXd& values, int digits, const std::string& mark) {
  if (values.size() > kMostNumbers && values.minCoeff() < values.maxCoeff()) {
    return fmt::format("{}{} to {}", mark, number_text(values.minCoeff(), digits),
                       number_text(values.maxCoeff(), digits));
  }
  std::string text = mark;
  // Of many that are all alike one is enough.
  const Index n = values.size() > kMostNumbers ? 1 : values.size();
  for (Index k = 0; k < n; ++k) {
    text += (k > 0 ? "  " : "") + number_text(values[k], digits);
  }
  return text;
}

}  // namespace

std::string numbers_text(const Eigen::VectorXd& values, bool is_rough) {
  if (is_rough) return numbers_text(values, kRoughDigits, "≈ ");
  return numbers_text(values, values.size() == 1 ? kDigits : kDigitsOfMany, "");
}

std::string errors_text(const Eigen::VectorXd& errors) {
  return numbers_text(errors, kRoughDigits, "");
}

}  // namespace viewer
