#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "radiosity/assembly/transport_options.h"
#include "radiosity/compressed/compressed_transport.h"
#include "radiosity/exchange/exchange_evaluator.h"
#include "radiosity/operator/transport.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/visibility/visibility.h"

namespace radiosity {

/// A polygon that light comes from, and what it exchanges with each patch of the mesh.
struct LightPolygon {
  std::vector<std::int32_t> patches;  ///< that divide it, in rising order
  Eigen::VectorXd exchange;           ///< m², n
};

/// The patches of each polygon that emits, `exitance` n x k or empty; none if these are more than
/// light is taken from exactly.
std::vector<std::vector<std::int32_t>> emitting_polygons(const PatchMesh& mesh,
                                                         const Eigen::MatrixXd& exitance);

/// What the polygons exchange with all patches, each pair as one, to a share of the tolerance. Left
/// out are polygons that are not convex and plane, or that solids cover in part.
std::vector<LightPolygon> make_light_polygons(
    const ExchangeEvaluator& evaluator, const PatchMesh& mesh,
    const std::vector<std::vector<std::int32_t>>& polygons, const TransportOptions& options);

/// Adds to an operator whose rows are not closed what its blocks lack of that exchange, and closes
/// them if its report says that the scene is closed (find_closed_sums).
void close_with_light(CompressedTransport& transport, const std::vector<LightPolygon>& lights,
                      const PatchMesh& mesh, const Visibility& visibility,
                      const TransportOptions& options);

/// For other light than a compressed operator was made for: adds what it lacks of the exchange with
/// the polygons that emit now, and closes the rows anew if they were closed. Nothing changes if it
/// has them all, and others than compressed ones lack nothing. `options` are those that it was made
/// with. Throws Interrupted.
void add_missing_light(Transport& transport, const PatchMesh& mesh, const Visibility& visibility,
                       const TransportOptions& options, const Eigen::MatrixXd& exitance);

}  // namespace radiosity
