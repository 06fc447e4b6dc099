#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}  // namespace CLI

namespace apps {

/// Whether .glb files show a picture of the light on their surfaces, and where else it goes.
struct LightmapOptions {
  bool wanted = false;
  int size = 1024;                   ///< texels a side, at most
  std::vector<std::string> atlases;  ///< .png or .exr files
};

/// Binds the options to the command; `options` must outlive the parsing.
void add_lightmap_options(CLI::App& command, LightmapOptions& options);

/// Throws CLI::ValidationError if a lightmap is wanted that none of the outputs would show.
void check_lightmap(const LightmapOptions& options, const std::vector<std::string>& outputs);

}  // namespace apps
