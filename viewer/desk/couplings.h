#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "radiosity/scene/scene.h"
#include "radiosity/solve/exchange_network.h"
#include "radiosity/solve/surface_flux.h"
#include "viewer/work/session.h"

namespace viewer {

/// How a surface exchanges heat with another one, reflections and all.
struct Coupling {
  std::string name;    ///< of the other: a surface, "space" or "backs"
  double area = 0;     ///< GR, m²: it gains the heat σ GR (T_other⁴ - T⁴)
  double gebhart = 0;  ///< share of what the surface emits that is absorbed there
};

/// Those of a surface, the largest first, but for such below 1e-6 of what it emits; none without a
/// network. `names` are the surfaces'.
std::vector<Coupling> couplings(const radiosity::ExchangeNetwork* network,
                                const std::vector<std::string>& names, std::int32_t surface);

/// The surface that is asked about: that of the selected patch.
std::optional<std::int32_t> asked_surface(const Session& session);

/// "couples most with shroud, GR 0.123 m²"; "" without a network.
std::string coupling_text(const radiosity::ExchangeNetwork* network,
                          const std::vector<std::string>& names, std::int32_t surface);

/// What a surface absorbs of the sun's light, straight and reflected, W: Σ A (1 - ρ) H in the solar
/// band; empty unless the bands have such a one and the fluxes are known.
std::optional<double> absorbed_sunlight(const radiosity::Bands& bands,
                                        std::span<const radiosity::SurfaceFlux> fluxes,
                                        std::int32_t surface);

}  // namespace viewer
