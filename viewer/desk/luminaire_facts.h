#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "radiosity/scene/scene.h"
#include "viewer/work/light_mix.h"

namespace viewer {

/// What is known of one luminaire of the scene.
struct LuminaireFacts {
  std::string name;
  std::string file;         ///< its photometric file, without the folder
  double lumens = 0;        ///< at full strength, lm
  std::size_t emitter = 0;  ///< of the mix, that dims it
};

/// One for each luminaire, in the scene's order.
std::vector<LuminaireFacts> luminaire_facts(const radiosity::Scene& scene, const LightMix& mix);

/// "3700 lm".
std::string lumens_text(double lumens);
/// "panel-1-2: 3700 lm, dimmed to 1850 lm, office-panel.ies".
std::string luminaire_text(const LuminaireFacts& luminaire, const LightMix& mix);

}  // namespace viewer
