#pragma once

#include <functional>
#include <memory>

#include "radiosity/base/progress.h"
#include "radiosity/solve/solution.h"
#include "viewer/work/light_mix.h"
#include "viewer/work/model.h"

namespace viewer {

/// Told each time the light has spread further, with the direct light that it began with and the
/// unshot share of the emitted power.
using Previewed = std::function<void(radiosity::Solution, std::shared_ptr<const OuterLight> outer,
                                     double unshot_share)>;

/// Spreads the mix's light by progressive shooting until little is unshot: for some seconds as fast
/// as it can, then for a part of the time only, since the form factors need the rest. Throws
/// Interrupted.
void preview(const Model& model, const LightMix& mix, const Previewed& previewed,
             const radiosity::Progress& progress);

}  // namespace viewer
