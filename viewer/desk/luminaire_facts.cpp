#include "viewer/desk/luminaire_facts.h"

#include <fmt/format.h>

#include "viewer/desk/patch_facts.h"

namespace viewer {

std::vector<LuminaireFacts> luminaire_facts(const radiosity::Scene& scene, const LightMix& mix) {
  std::vector<double> web_lumens;
  for (const radiosity::Photometry& photometry : scene.photometries) {
    web_lumens.push_back(flux(photometry.web));
  }
  std::vector<LuminaireFacts> facts;
  for (const radiosity::Luminaire& luminaire : scene.luminaires) {
    const auto p = static_cast<std::size_t>(luminaire.photometry);
    facts.push_back({.name = luminaire.name,
                     .file = scene.photometries[p].file.filename().string(),
                     .lumens = luminaire.lumens > 0 ? luminaire.lumens : web_lumens[p]});
  }
  for (std::size_t e = 0; e < mix.emitters.size(); ++e) {
    for (const int k : mix.emitters[e].luminaires) facts[k].emitter = e;
  }
  return facts;
}

std::string lumens_text(double lumens) {
  constexpr double kMany = 100;  // of which nobody asks for tenths
  return (lumens < kMany ? number_text(lumens) : fmt::format("{:.0f}", lumens)) + " lm";
}

std::string luminaire_text(const LuminaireFacts& luminaire, const LightMix& mix) {
  const Emitter& emitter = mix.emitters[luminaire.emitter];
  std::string text = fmt::format("{}: {}, ", luminaire.name, lumens_text(luminaire.lumens));
  if (!emitter.is_on) {
    text += "off, ";
  } else if (emitter.scale != 1) {
    text += fmt::format("dimmed to {}, ", lumens_text(emitter.scale * luminaire.lumens));
  }
  return text + luminaire.file;
}

}  // namespace viewer
