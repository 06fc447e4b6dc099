#pragma once

#include <string>
#include <vector>

#include "apps/options/common_options.h"
#include "apps/options/lightmap_options.h"
#include "apps/terminal/interruption.h"
#include "radiosity/base/progress.h"
#include "study/study.h"

namespace apps {

/// Draws the lightmap of a solved scene and writes it to those of the outputs that are .glb files
/// and to the files of the options, each under `interruption.hold()`. Of `picture` whether light is
/// gathered and the exposure count. Throws MeshError if the polygons do not fit into it.
void write_lightmap(const study::Study& solved, const std::vector<std::string>& outputs,
                    const LightmapOptions& options, const PictureOptions& picture,
                    const radiosity::Progress& progress, Interruption& interruption);

}  // namespace apps
