#pragma once

#include "apps/options/common_options.h"
#include "apps/terminal/interruption.h"

namespace apps {

/// `radiosity inspect FILE.ies|FILE.ldt`: tells what a luminaire gives, and draws its polar curve
/// to the outputs. Throws SceneError and OutputError.
void inspect_photometry(const CommonOptions& common, Interruption& interruption);

}  // namespace apps
