#include "viewer/desk/show_info.h"

#include <algorithm>
#include <array>
#include <cassert>

#include "radiosity/solve/quantity.h"

namespace viewer {
namespace {

constexpr std::string_view kLight = "Light, as the eye sees it";
constexpr std::string_view kPower = "Radiation, by its power";
constexpr std::string_view kExchange = "Exchange, of a patch that is asked";
constexpr std::string_view kIteration = "Iteration, at the step that is shown";
constexpr std::string_view kSurfaces = "Surfaces and errors";

constexpr std::array kGroups = {kLight, kPower, kExchange, kIteration, kSurfaces};

constexpr std::array<ShowInfo, 27> kInfos = {{
    {"true-colour", kLight, "true colour", "",
     "The light that leaves each patch, as the eye would see it: radiosity B times an exposure."},
    {"illuminance", kLight, "illuminance", "lux",
     "Light that arrives on a square metre: E = Σ_b w_b H_b, the bands weighted as the eye does."},
    {"work-plane", kLight, "work plane", "",
     "What arrives from above at a level plane over the floor, at each point anew: H(x) = Σ_j B_j "
     "F(x → j), in lux or, of heat, in W/m²."},
    {"grid", kLight, "grid of the scene", "",
     "What arrives at the points of a grid that the scene asks for, each anew, with exact "
     "shadows."},
    {"luminance", kLight, "luminance", "cd/m²",
     "How bright a patch looks, the same from all sides: L = Σ_b w_b B_b / π."},
    {"luminous-exitance", kLight, "luminous exitance", "lm/m²",
     "Light that leaves a square metre, emitted and reflected: M_v = Σ_b w_b B_b."},
    {"luminous-flux", kLight, "luminous flux", "lm",
     "Light that leaves the whole patch: Φ = A Σ_b w_b B_b."},
    {"radiosity", kPower, "radiosity", "W/m²",
     "All that leaves, emitted and reflected: B = M + ρ H."},
    {"irradiance", kPower, "irradiance", "W/m²", "All that arrives: H_i = Σ_j F_ij B_j."},
    {"direct", kPower, "direct irradiance", "W/m²",
     "What arrives straight from what emits: Σ_j F_ij M_j and, of luminaires, sun and sky, E."},
    {"indirect", kPower, "indirect irradiance", "W/m²",
     "What arrives by way of reflections: H_i − Σ_j F_ij M_j − E, E straight from luminaires, sun "
     "and sky."},
    {"incident", kPower, "incident from without", "W/m²",
     "What arrives from the sun, E = E_n cosθ times the share of the patch that is lit, and from "
     "the "
     "environment, (1 − Σ_j F_ij) M_e."},
    {"absorbed", kPower, "absorbed", "W/m²", "What stays of all that arrives: (1 − ρ) H."},
    {"radiance", kPower, "radiance", "W/(m² sr)",
     "What leaves in any direction, of a surface that scatters evenly: L = B / π."},
    {"exitance", kPower, "emitted (exitance)", "W/m²", "What a surface emits by itself: M."},
    {"net-flux", kPower, "net flux", "W/m²",
     "What a patch loses by radiation: q = B − H; below 0 it gains."},
    {"power", kPower, "power", "W", "All that leaves the whole patch: A B."},
    {"form-factors", kExchange, "form factors from the patch", "",
     "The share of what the patch sends that arrives at each other one: F_ij = 1/A_i ∫∫ cosθ_i "
     "cosθ_j / (π r²) V dA_j dA_i, V being 1 where they see each other."},
    {"arriving", kExchange, "light sent to the patch", "W/m² per m²",
     "What each patch j sends to the patch i that is asked, for each square metre of j: F_ij B_j / "
     "A_j."},
    {"light-path", kExchange, "importance for the patch", "1/m²",
     "Radiosity that the patch gets, by all reflections, of a watt that is emitted there: dB_i / "
     "d(A_j M_j)."},
    {"watched", kIteration, "light so far", "",
     "The light after so many steps, in true colour: B_k of an iteration that was recorded."},
    {"unshot", kIteration, "light not passed on yet (unshot)", "W/m²",
     "Light that has arrived at the step and is not reflected yet: M + ρ F B_k − B_k."},
    {"reflectance", kSurfaces, "reflectance", "",
     "The share of what arrives that is reflected: ρ."},
    {"error", kSurfaces, "error of radiosity (1 σ)", "W/m²",
     "One standard error of B, by form factors and iteration: B is known to about ± 2 σ."},
    {"temperature", kSurfaces, "temperature", "K",
     "What a patch is at, as given or as its heat makes it: σ T⁴ = (B − (1 − ε) H) / ε."},
    {"unseen", kSurfaces, "unseen share", "",
     "What the form factors of a patch lack to 1, as they were before a closed scene was "
     "corrected: "
     "1 − covered − Σ_j F_ij."},
    {"area", kSurfaces, "area of the patches", "m²",
     "The area A of each patch: how finely the scene is divided."},
}};

}  // namespace

std::span<const std::string_view> show_groups() { return kGroups; }

const ShowInfo& show_info(std::string_view name) {
  const auto* found = std::find_if(kInfos.begin(), kInfos.end(),
                                   [&](const ShowInfo& info) { return info.name == name; });
  assert(found != kInfos.end());
  return *found;
}

std::string caption_with_unit(const ShowInfo& info, const radiosity::Bands& bands) {
  std::string text(info.caption);
  if (info.unit.empty()) return text;
  const bool is_of_bands = info.group != kLight && info.name != "area" && info.name != "light-path";
  const std::string unit =
      is_of_bands ? radiosity::band_unit(info.unit, bands) : std::string(info.unit);
  return text + " (" + unit + ")";
}

}  // namespace viewer
