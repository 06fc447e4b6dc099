#pragma once

#include <cstddef>

#include "radiosity/base/geometry.h"

namespace apps {

/// Bytes that this program may reasonably take: nine tenths of what the machine has available or of
/// what the control group (container) still allows, whichever is less. The rest is for the mesh,
/// the ray tracer and the result. 0 if the system does not tell.
std::size_t usable_memory();

/// Largest number of patches whose dense transport operator fits into `bytes`, rounded down to two
/// digits; 0 if not even ten fit.
radiosity::Index largest_problem(std::size_t bytes);

/// Throws SolveError, with the figures and the way out, if the transport operator of `n_patches`
/// does not fit into `memory` bytes (0 = unknown: never throws). `n_polygons` is the number of
/// polygons of the scene, below which no choice of patches can go.
void check_memory(radiosity::Index n_patches, radiosity::Index n_polygons, std::size_t memory);

/// Memory for streamed form factors if nobody says how much: half of what is usable.
std::size_t default_streaming_memory();

/// The same check for form factors that are streamed through a work file; the message tells the
/// least that works.
void check_streaming_memory(radiosity::Index n_patches, std::size_t memory);

}  // namespace apps
