#pragma once

#include <memory>

#include "meshing/patches/patches.h"
#include "radiosity/assembly/transport_options.h"
#include "radiosity/base/progress.h"
#include "radiosity/compressed/make_transport.h"
#include "radiosity/operator/transport.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/scene/scene.h"
#include "radiosity/solve/solve.h"
#include "radiosity/visibility/visibility.h"

namespace meshing {

/// Number of patches at which refinement ends if nobody says another; any may be said.
inline constexpr long kMostAdaptivePatches = 20000;

struct AdaptiveOptions {
  double tolerance = 1e-2;  ///< relative error of the radiosity at which refinement ends, > 0
  long max_patches = kMostAdaptivePatches;  ///< at which it ends too, about; fewer if what a round
                                            ///< needs for so many does not fit into memory
  radiosity::TransportOptions transport = {};  ///< of the form factors
  radiosity::TransportChoice choice = {};      ///< how they are kept, in each round
  radiosity::Progress progress = {};
};

/// What refinement did.
struct Refinement {
  int n_rounds = 0;
  double error = 0;          ///< estimated, with a margin, as asked by `tolerance`
  bool is_accurate = false;  ///< whether that is met
  double seconds = 0;        ///< wall time, form factors included
};

/// Patches that fit the light, and their form factors.
struct AdaptiveMesh {
  radiosity::PatchMesh mesh;
  radiosity::Visibility visibility;
  std::unique_ptr<radiosity::Transport> transport;
  Refinement refinement = {};
};

/// What is asked is to be met by an estimate that may itself be half as much again.
inline constexpr double kErrorMargin = 1.5;

/// Patches small where the light varies: starts from coarse ones, cut where other surfaces stand on
/// them (`contact_lines`), then solves and divides those whose variation matters most
/// (`refinement_indicator`), until the estimated error is met or the patches are spent. Dense form
/// factors between patches that stay are kept; compressed ones, of which make_transport has some
/// from kMostDense patches on, are made anew in each round. Patches within which a texture varies
/// are divided first, up to a quarter of the most there may be. The error is kErrorMargin times
/// `DiscretisationError::relative`, which is an estimate. Throws what make_patches, make_transport
/// and solve throw.
AdaptiveMesh make_adaptive_patches(const radiosity::Scene& scene,
                                   const AdaptiveOptions& options = {});

}  // namespace meshing
