#pragma once

#include <string>
#include <vector>

#include "apps/options/common_options.h"
#include "radiosity/exchange/sampled_destinations.h"
#include "study/study.h"

namespace apps {

/// The form factors from one point or surface.
struct FactorsFrom {
  std::string from;                        ///< as the user gave it
  std::vector<std::string> surface_names;  ///< of the scene, in its order
  radiosity::DestinationEstimate shares;   ///< to these surfaces, backs and sky
};

/// Computes them: from a point exactly; from a surface by the form factors of all pairs of patches,
/// with the sky and backs from points on it. Warns if the shares do not add up to 1. Throws as
/// parse_origin and study::assemble do.
FactorsFrom compute_factors_from(const std::string& from, const CommonOptions& common,
                                 const study::StudyOptions& compute,
                                 const study::StudyEvents& events);

}  // namespace apps
