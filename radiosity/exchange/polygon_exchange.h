#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "radiosity/base/progress.h"
#include "radiosity/exchange/exchange_evaluator.h"

namespace radiosity {

/// Exchange areas between all patches and a polygon that patches of the mesh divide, as one: n, m².
/// It is convex, of at most as many corners as a patch may have after cuts (kMostCorners), relative
/// to the evaluator's PreparedMesh::center, and `patch` is one of its patches. Errors are a share
/// of `tolerance` of each patch's. Parallel; the same bits at any number of threads.
Eigen::VectorXd polygon_exchange(const ExchangeEvaluator& evaluator, const ConvexPolygon& polygon,
                                 std::int32_t patch, double tolerance, std::uint64_t seed,
                                 const Progress& progress);

}  // namespace radiosity
