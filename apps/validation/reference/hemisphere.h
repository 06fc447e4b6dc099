#pragma once

#include <cstdint>
#include <vector>

#include "apps/validation/reference/own_light.h"
#include "radiosity/base/geometry.h"
#include "radiosity/solve/solution.h"

namespace apps::validation {

/// The irradiance of a patch, computed twice.
struct TwofoldIrradiance {
  double by_rays = 0;  ///< H = ∫ B(x') cosθ dω / π over the hemisphere, W/m²
  double by_area = 0;  ///< (F B)_i, W/m²
  double error = 0;    ///< one standard error of the difference, W/m²
};

struct HemisphereOptions {
  int n_rays = 2000;            ///< per patch
  radiosity::Index stride = 3;  ///< every how manieth patch
  std::uint64_t seed = 0;
};

/// The first band's irradiance by the rendering equation's two forms: rays with density cosθ / π
/// from random points of the patch fetch B where they first meet a patch; and the form factors.
/// Rays seldom meet a small lamp, and a sample without it knows nothing of its variance: the
/// error is that of the area form where that is larger.
std::vector<TwofoldIrradiance> compare_irradiance(const study::Study& assembly,
                                                  const radiosity::Solution& solution,
                                                  const HemisphereOptions& options = {});

}  // namespace apps::validation
