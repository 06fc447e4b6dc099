#include "viewer/desk/surface_totals.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "radiosity/scene/radiometry.h"
#include "radiosity/solve/quantity.h"
#include "radiosity/solve/surface_flux.h"

namespace viewer {
namespace {

using radiosity::Index;

constexpr std::array<std::string_view, 6> kColumns = {"name",       "area", "flux",
                                                      "irradiance", "heat", "temperature"};
constexpr double kCelsius = 273.15;  // K at 0 °C

std::optional<double> value_of(const SurfaceTotal& total, TotalColumn column) {
  switch (column) {
    case TotalColumn::name:
      break;
    case TotalColumn::area:
      return total.area;
    case TotalColumn::flux:
      return total.flux;
    case TotalColumn::irradiance:
      return total.irradiance;
    case TotalColumn::heat:
      return total.heat;
    case TotalColumn::temperature:
      return total.temperature;
  }
  return std::nullopt;
}

/// By how much the mix makes a surface emit more than in the file.
double factor_of(const Session& session, std::int32_t surface) {
  for (const Emitter& emitter : session.mix().emitters) {
    const auto& surfaces = emitter.surfaces;
    if (std::find(surfaces.begin(), surfaces.end(), surface) != surfaces.end()) {
      return emitter.factor();
    }
  }
  return 1;
}

/// Adds what the light gives each surface; weights of the bands as the eye has them, or 1.
void add_light(std::vector<SurfaceTotal>& totals, const Known& known) {
  const radiosity::PatchMesh& mesh = *known.model.mesh;
  const radiosity::Solution& solution = known.light->solution;
  const bool is_thermal = known.model.scene && radiosity::is_thermal(*known.model.scene);
  const Eigen::VectorXd weights =
      is_thermal ? Eigen::VectorXd(Eigen::VectorXd::Ones(solution.radiosity.cols()))
                 : radiosity::luminous_weights(known.model.bands);
  const Eigen::VectorXd leaving = solution.radiosity * weights;
  const Eigen::VectorXd arriving = solution.irradiance * weights;
  std::vector<double> flux(totals.size());
  std::vector<double> arrived(totals.size());
  for (Index i = 0; i < mesh.size(); ++i) {
    flux[mesh.surface[i]] += mesh.area[i] * leaving[i];
    arrived[mesh.surface[i]] += mesh.area[i] * arriving[i];
  }
  for (std::size_t s = 0; s < totals.size(); ++s) {
    if (!(totals[s].area > 0)) continue;
    totals[s].flux = flux[s];
    totals[s].irradiance = arrived[s] / totals[s].area;
    if (is_thermal) totals[s].heat = flux[s] - arrived[s];
  }
}

}  // namespace

std::optional<double> surface_temperature(const Session& session, std::int32_t surface) {
  const auto& scene = session.model().scene;
  if (!scene) return std::nullopt;
  const auto& emission = scene->materials[scene->surfaces[surface].material].emission;
  if (emission.kind != radiosity::Emission::Kind::temperature) return std::nullopt;
  return emission.value[0] * std::pow(factor_of(session, surface), 0.25);  // M = ε σ T⁴
}

double celsius(double kelvin) { return kelvin - kCelsius; }

std::string temperature_text(double kelvin) {
  return fmt::format("{:.1f} K, {:.1f} °C", kelvin, celsius(kelvin));
}

void set_temperatures(std::vector<SurfaceTotal>& totals, const Session& session) {
  for (SurfaceTotal& total : totals) {
    total.temperature = surface_temperature(session, total.surface);
  }
}

std::vector<SurfaceTotal> surface_totals(const Session& session) {
  std::vector<SurfaceTotal> totals = surface_totals(session.known());
  set_temperatures(totals, session);
  return totals;
}

std::vector<SurfaceTotal> surface_totals(const Known& known) {
  const Model& model = known.model;
  if (!model.mesh) return {};
  const radiosity::PatchMesh& mesh = *model.mesh;
  std::vector<SurfaceTotal> totals(mesh.surface_names.size());
  for (std::size_t s = 0; s < totals.size(); ++s) {
    totals[s].surface = static_cast<std::int32_t>(s);
    totals[s].name = mesh.surface_names[s];
    if (model.scene) {
      totals[s].material = model.scene->materials[model.scene->surfaces[s].material].name;
    }
  }
  for (Index i = 0; i < mesh.size(); ++i) {
    SurfaceTotal& total = totals[mesh.surface[i]];
    ++total.n_patches;
    total.area += mesh.area[i];
  }
  if (known.light) add_light(totals, known);
  return totals;
}

std::optional<TotalColumn> total_column_named(std::string_view name) {
  const auto* found = std::find(kColumns.begin(), kColumns.end(), name);
  if (found == kColumns.end()) return std::nullopt;
  return static_cast<TotalColumn>(found - kColumns.begin());
}

void sort(std::vector<SurfaceTotal>& totals, const TotalOrder& order) {
  std::stable_sort(totals.begin(), totals.end(), [&](const SurfaceTotal& a, const SurfaceTotal& b) {
    if (order.column == TotalColumn::name) {
      return order.is_falling ? b.name < a.name : a.name < b.name;
    }
    const auto value = value_of(a, order.column);
    const auto other = value_of(b, order.column);
    if (!value || !other) return value.has_value() && !other.has_value();
    return order.is_falling ? *value > *other : *value < *other;
  });
}

std::optional<std::int32_t> surface_named(const radiosity::PatchMesh& mesh,
                                          const std::string& name) {
  const auto& names = mesh.surface_names;
  const auto found = std::find(names.begin(), names.end(), name);
  if (found != names.end()) return static_cast<std::int32_t>(found - names.begin());
  std::int32_t index = -1;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), index);
  const bool is_index = error == std::errc() && end == name.data() + name.size() && index >= 0 &&
                        static_cast<std::size_t>(index) < names.size();
  return is_index ? std::optional(index) : std::nullopt;
}

}  // namespace viewer
