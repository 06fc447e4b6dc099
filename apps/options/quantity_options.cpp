#include "apps/options/quantity_options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/App.hpp>
#include <algorithm>

#include "apps/terminal/number_list.h"
#include "radiosity/base/error.h"
#include "radiosity/solve/surface_flux.h"

namespace apps {
namespace {

using radiosity::Bands;
using radiosity::Quantity;

// The part of the spectrum that counts: beyond, V(λ) is below 0.005.
constexpr double kVisibleFrom = 400;  // nm
constexpr double kVisibleTo = 700;

std::string quantity_names() {
  std::vector<std::string_view> names;
  for (const auto& info : radiosity::quantity_infos()) names.push_back(info.name);
  return fmt::format("{}", fmt::join(names, ", "));
}

void check_wavelengths(const radiosity::Scene& scene, TerminalProgress& terminal) {
  const std::vector<double>& x = scene.bands.wavelengths;
  if (x.size() < 2) {
    throw radiosity::SceneError(
        fmt::format("{}: a photometric quantity is an integral over wavelengths, but the scene has "
                    "only one, {} nm",
                    scene.source, x.front()));
  }
  if (x.front() > kVisibleFrom || x.back() < kVisibleTo) {
    terminal.warn(
        fmt::format("the bands cover {} to {} nm, not all of {} to {} nm: photometric quantities "
                    "lack the light outside",
                    x.front(), x.back(), kVisibleFrom, kVisibleTo));
  }
}

}  // namespace

void add_photometry_options(CLI::App& command, PhotometryOptions& options) {
  command
      .add_option("--efficacy", options.efficacy,
                  fmt::format("Luminous efficacy of RGB and grey bands, lm/W, for photometric "
                              "quantities; default: {} by convention",
                              radiosity::kWhiteEfficacy))
      ->check(check_positive)
      ->type_name("K");
}

void add_quantity_options(CLI::App& command, QuantityOptions& options) {
  command
      .add_option("--quantity", options.names,
                  "Add a quantity to all outputs, may be repeated: " + quantity_names())
      ->check(check_quantity)
      ->type_name("Q")
      ->allow_extra_args(false);
}

std::string check_quantity(const std::string& name) {
  if (radiosity::quantity_named(name)) return "";
  return fmt::format("found '{}', expected one of {}", name, quantity_names());
}

std::vector<Quantity> chosen_quantities(const QuantityOptions& options) {
  std::vector<Quantity> chosen;
  for (const std::string& name : options.names) {
    const Quantity quantity = *radiosity::quantity_named(name);
    if (std::find(chosen.begin(), chosen.end(), quantity) == chosen.end()) {
      chosen.push_back(quantity);
    }
  }
  return chosen;
}

void check_photometry(const radiosity::Scene& scene, const std::vector<Quantity>& quantities,
                      const PhotometryOptions& options, TerminalProgress& terminal) {
  if (std::find(quantities.begin(), quantities.end(), Quantity::temperature) != quantities.end() &&
      !(radiosity::is_thermal(scene) && scene.bands.kind == Bands::Kind::grey)) {
    throw radiosity::SceneError(
        fmt::format("{}: has no temperatures: that takes \"bands\": \"grey\" and a material with a "
                    "temperature or heat",
                    scene.source));
  }
  const bool photometric = std::any_of(quantities.begin(), quantities.end(), [](Quantity quantity) {
    return radiosity::quantity_info(quantity).is_photometric;
  });
  const bool has_wavelengths = scene.bands.kind == Bands::Kind::wavelengths;
  if (options.efficacy && (!photometric || has_wavelengths)) {
    terminal.warn(
        photometric ? "--efficacy has no effect: the bands are wavelengths, seen by the eye's V(λ)"
                    : "--efficacy has no effect without a photometric quantity");
  }
  if (!photometric) return;
  if (options.efficacy && !has_wavelengths && !scene.luminaires.empty()) {
    terminal.warn(
        fmt::format("luminaires are reckoned with {} lm/W: --efficacy {} makes {:.4g} lm of each "
                    "of their lumens",
                    radiosity::kWhiteEfficacy, *options.efficacy,
                    *options.efficacy / radiosity::kWhiteEfficacy));
  }
  if (has_wavelengths) check_wavelengths(scene, terminal);
  if (radiosity::is_thermal(scene)) {
    terminal.warn(
        "the scene emits by temperature, all wavelengths together: hardly any of it is light, and "
        "photometric quantities mean nothing");
  }
}

}  // namespace apps
