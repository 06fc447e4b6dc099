#include "viewer/desk/couplings.h"

#include <fmt/format.h>

#include <algorithm>

#include "viewer/desk/patch_facts.h"

namespace viewer {
namespace {

using radiosity::Index;

constexpr double kLeastCoupling = 1e-6;  // of what the surface emits

}  // namespace

std::vector<Coupling> couplings(const radiosity::ExchangeNetwork* network,
                                const std::vector<std::string>& names, std::int32_t surface) {
  std::vector<Coupling> found;
  if (network == nullptr || surface < 0 || surface >= network->emitting.size()) return found;
  const double emitting = network->emitting[surface];
  if (!(emitting > 0)) return found;
  const auto add = [&](const std::string& name, double area) {
    if (area < kLeastCoupling * emitting) return;
    found.push_back({.name = name, .area = area, .gebhart = area / emitting});
  };
  for (Index other = 0; other < network->couplings.cols(); ++other) {
    add(names[static_cast<std::size_t>(other)], network->couplings(surface, other));
  }
  add("space", network->to_space[surface]);
  add("backs", network->to_backs[surface]);
  std::stable_sort(found.begin(), found.end(),
                   [](const Coupling& a, const Coupling& b) { return a.area > b.area; });
  return found;
}

std::optional<std::int32_t> asked_surface(const Session& session) {
  const auto patch = session.selected();
  if (!patch) return std::nullopt;
  return session.model().mesh->surface[static_cast<std::size_t>(*patch)];
}

std::string coupling_text(const radiosity::ExchangeNetwork* network,
                          const std::vector<std::string>& names, std::int32_t surface) {
  const std::vector<Coupling> all = couplings(network, names, surface);
  if (all.empty()) return "";
  return fmt::format("couples most with {}, GR {} m²", all.front().name,
                     number_text(all.front().area));
}

std::optional<double> absorbed_sunlight(const radiosity::Bands& bands,
                                        std::span<const radiosity::SurfaceFlux> fluxes,
                                        std::int32_t surface) {
  const bool has_solar_band = bands.kind == radiosity::Bands::Kind::solar_infrared;
  const auto s = static_cast<std::size_t>(surface);
  if (!has_solar_band || s >= fluxes.size()) return std::nullopt;
  return -fluxes[s].band_heat[0] + 0.0;  // what is absorbed is lost less than nothing
}

}  // namespace viewer
