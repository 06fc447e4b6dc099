#pragma once

#include <cstdint>

#include "radiosity/base/progress.h"
#include "radiosity/exchange/point_factors.h"
#include "radiosity/scene/patch_mesh.h"

namespace radiosity {

/// Shares with one standard error each.
struct DestinationEstimate {
  Destinations value;
  Destinations error;  ///< 0: exact up to rounding
};

struct SamplingOptions {
  int n_points = 1024;     ///< on the surface, at least 16
  std::uint64_t seed = 0;  ///< of the points
  Progress progress{};
};

/// Where the power goes that leaves a surface, evenly over its area (both sides if two-sided): the
/// mean of the exact point_factors of quasi-random points, with the standard error of sixteen
/// independent means. `surface` has area. The same bits at any number of threads. Throws
/// Interrupted if asked to stop.
DestinationEstimate sampled_destinations(const PatchMesh& mesh, std::int32_t surface,
                                         const SamplingOptions& options = {});

}  // namespace radiosity
