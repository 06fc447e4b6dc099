#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/terminal/terminal_progress.h"
#include "radiosity/scene/scene.h"
#include "radiosity/solve/quantity.h"

namespace CLI {
class App;
}  // namespace CLI

namespace apps {

/// How bands become photometric quantities.
struct PhotometryOptions {
  std::optional<double> efficacy;  ///< lm/W, of RGB and grey bands; absent: by convention

  [[nodiscard]] double efficacy_or_default() const {
    return efficacy.value_or(radiosity::kWhiteEfficacy);
  }
};

/// Which quantities are added to the outputs.
struct QuantityOptions {
  std::vector<std::string> names;  ///< as `radiosity::QuantityInfo::name`
};

/// These bind the options to the command; `options` must outlive the parsing.
void add_photometry_options(CLI::App& command, PhotometryOptions& options);
void add_quantity_options(CLI::App& command, QuantityOptions& options);

/// For the command line's check: empty if `name` is a quantity, else what was found and all names.
std::string check_quantity(const std::string& name);

/// The quantities of names that have been checked, each once.
std::vector<radiosity::Quantity> chosen_quantities(const QuantityOptions& options);

/// Before the long work: warns if a photometric one of these quantities leaves out visible light,
/// or means little in this scene. Throws SceneError if it cannot be had at all.
void check_photometry(const radiosity::Scene& scene,
                      const std::vector<radiosity::Quantity>& quantities,
                      const PhotometryOptions& options, TerminalProgress& terminal);

}  // namespace apps
