#pragma once

#include <cstddef>

#include "radiosity/base/geometry.h"

namespace radiosity {

/// Memory that a dense operator of n patches takes at most, bytes: 2 n² plus the entries' errors.
std::size_t dense_transport_bytes(Index n_patches);

/// Largest number of patches whose dense operator fits into `memory` bytes (0 = what the machine
/// has), rounded down to two digits; 0 if not even ten fit. Empty of meaning where the machine does
/// not tell what it has: then it is the largest number that an operator can have.
Index largest_problem(std::size_t memory = 0);

/// Throws MemoryShortage, with the figures and the way out, if the dense operator of `n_patches`
/// does not fit into `memory` bytes (0 = what the machine has; never throws if it does not tell).
/// `n_polygons` is the number of polygons of the scene, below which no choice of patches can go; 0
/// if it is not known. Of several ranks each keeps its share, and `memory` is that of one.
void check_memory(Index n_patches, Index n_polygons, std::size_t memory = 0, int n_ranks = 1);

}  // namespace radiosity
