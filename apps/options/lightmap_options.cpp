#include "apps/options/lightmap_options.h"

#include <CLI/App.hpp>
#include <algorithm>

#include "apps/terminal/output_files.h"

namespace apps {

void add_lightmap_options(CLI::App& command, LightmapOptions& options) {
  const std::string lightmap = "Lightmap";
  constexpr int kSmallest = 16;
  constexpr int kLargest = 8192;
  auto* wanted = command
                     .add_flag("--lightmap", options.wanted,
                               "A .glb shows a picture of the light on all surfaces (with --gather "
                               "finer than the patches) instead of colours at corners")
                     ->group(lightmap);
  command.add_option("--lightmap-size", options.size, "Most texels along its sides")
      ->check(CLI::Range(kSmallest, kLargest))
      ->capture_default_str()
      ->type_name("N")
      ->group(lightmap)
      ->needs(wanted);
  command
      .add_option("--atlas", options.atlases,
                  "Write the lightmap to this file, too: .exr (linear radiance) or .png; may be "
                  "repeated")
      ->check([](const std::string& path) { return check_extension(path, picture_extensions()); })
      ->type_name("FILE")
      ->allow_extra_args(false)
      ->group(lightmap)
      ->needs(wanted);
}

void check_lightmap(const LightmapOptions& options, const std::vector<std::string>& outputs) {
  if (!options.wanted || !options.atlases.empty()) return;
  if (std::any_of(outputs.begin(), outputs.end(), is_glb)) return;
  throw CLI::ValidationError("--lightmap", "needs an output that shows it: -o FILE.glb or --atlas");
}

}  // namespace apps
