#pragma once

#include <optional>
#include <string>

#include "radiosity/base/progress.h"
#include "radiosity/scene/scene.h"

namespace CLI {
class App;
}  // namespace CLI

namespace apps {

/// Files with temperatures and heats of single patches or polygons.
struct HeatOptions {
  std::optional<std::string> temperatures;
  std::optional<std::string> heat_fluxes;
};

/// Binds --temperatures and --heat-fluxes to the command; `options` must outlive the parsing.
void add_heat_options(CLI::App& command, HeatOptions& options);

/// Reads what the files give into the scene, and adds them to its files. Throws SceneError as
/// io::read_given_heat does; Interrupted.
void give_heat(const HeatOptions& options, radiosity::Scene& scene,
               const radiosity::Progress& progress);

}  // namespace apps
