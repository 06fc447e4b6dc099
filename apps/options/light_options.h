#pragma once

#include <optional>
#include <string>
#include <vector>

#include "radiosity/scene/light_plan.h"
#include "radiosity/scene/scene.h"

namespace CLI {
class App;
}  // namespace CLI

namespace apps {

/// What the command line asks for besides the scene.
struct LightOptions {
  std::vector<std::string> grids;      ///< "floor", "floor:0.75" or nine numbers
  std::vector<std::string> points;     ///< files
  std::vector<std::string> observers;  ///< six numbers
  std::optional<double> spacing;       ///< of `grids`, m
  std::optional<double> border;        ///< of `grids`, m
  bool is_cylindrical = false;         ///< at all points
  std::vector<std::string> vertical;   ///< directions, at all points
  std::vector<std::string> semi_cylindrical;
  std::vector<std::string> luminance_from;   ///< points, of all grids
  std::optional<double> maintenance_factor;  ///< in place of the scene's
};

/// Binds the options to the command; `options` must outlive the parsing.
void add_light_options(CLI::App& command, LightOptions& options);

/// The scene's own plan with what the options add, m. Throws SceneError if the scene has no such
/// surface, if there is nothing to measure, and as io::add_points does.
radiosity::LightPlan light_plan(const radiosity::Scene& scene, const LightOptions& options);

}  // namespace apps
