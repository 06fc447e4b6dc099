#pragma once

#include "apps/options/common_options.h"
#include "apps/terminal/interruption.h"

namespace apps {

/// Whether the table of CIE 117 is asked for, which takes half a minute.
enum class WantsUgr { no, yes };

/// `radiosity inspect FILE.ies|FILE.ldt`: tells what a luminaire gives, and draws its polar curve
/// to the outputs; `wants_ugr`: and its UGR table. Throws SceneError and OutputError.
void inspect_photometry(const CommonOptions& common, WantsUgr wants_ugr,
                        Interruption& interruption);

}  // namespace apps
