#pragma once

#include <optional>
#include <string>

#include "apps/options/common_options.h"
#include "apps/options/false_color_options.h"
#include "apps/terminal/interruption.h"
#include "radiosity/base/progress.h"
#include "study/study.h"

namespace apps {

/// Renders the picture of a solved scene and writes it; returns the scale if it is in false
/// colours. The file is written under `interruption.hold()`. Throws SceneError if all of it is
/// empty, which `check_picture` finds out beforehand unless it is for lack of pixels.
std::optional<ShownScale> write_picture(const std::string& path, const study::Study& solved,
                                        const PictureOptions& options,
                                        const radiosity::Progress& progress,
                                        Interruption& interruption);

}  // namespace apps
