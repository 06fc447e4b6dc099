#pragma once

#include <Eigen/Core>

#include "radiosity/base/geometry.h"
#include "radiosity/base/progress.h"
#include "radiosity/operator/transport.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/solve/solution.h"

namespace radiosity {

/// Share of the mean reflected light below which patches count as that bright in relative errors.
inline constexpr double kDarkShare = 0.05;

/// What is known about the error of taking the radiosity of each patch as constant.
struct DiscretisationError {
  Eigen::MatrixXd error;   ///< one standard error of each patch's mean radiosity, W/m², n x k
  Eigen::MatrixXd change;  ///< B less the solution on coarser patches, W/m², n x k
  double order = 0;        ///< measured order in the size of patches, in [1, 1.6]
  /// Root mean square over the area of the patches' errors relative to their reflected light ρ H
  /// (or to kDarkShare of its mean where they are darker), largest over the columns.
  double relative = 0;
  Index n_unknown = 0;  ///< patches alone in their group, which coarser patches tell nothing about
  double unknown_share =
      0;  ///< of the reflected light, that of these patches; largest of the columns
};

/// Compares the solution with those on patches about twice and four times the size, whose exchange
/// areas are sums of the ones at hand (AggregatedTransport), so that no form factor is computed.
/// With the change δ from the coarser to the given patches and the order p that the two changes
/// show, the error that is left is κ δ, κ = 1 / (2^p - 1) (Richardson 1911), of which the mean
/// square of a patch's own and of all around it is taken. That holds for light that varies over
/// several patches; `uneven_light_error` is what varies within one, as in gaps narrower than a
/// patch, and is left out of operators whose rows take a product each. One standard error is both
/// in quadrature; more than 95 % of patches lie within two. Patches alone in their group get at
/// least the mean relative square of the others in place of the first. Costs two solves to 1e-4,
/// all rows of F twice and a solve to 1e-2 with four columns per band.
DiscretisationError discretisation_error(const PatchMesh& mesh, const Transport& transport,
                                         const Solution& solution, const Progress& progress = {});

/// The solution with that error added to its `radiosity_error` in quadrature.
Solution with_discretisation_error(Solution solution, const DiscretisationError& discretisation);

}  // namespace radiosity
