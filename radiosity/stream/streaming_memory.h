#pragma once

#include <cstddef>

#include "radiosity/base/geometry.h"

namespace radiosity {

/// Memory that streaming the form factors of n patches takes beside the buffers, bytes: the
/// program, the patches and their ray tracer, vectors, and where each tile is.
std::size_t streaming_memory(Index n_patches);

/// The least that buffers may have, bytes.
std::size_t least_buffers(Index n_patches);

/// Memory for streamed form factors if nobody says how much, bytes: half of what is usable.
std::size_t default_streaming_memory();

/// Throws MemoryShortage, with the least that works, if the form factors of `n_patches` cannot be
/// streamed within `memory` bytes (0 = what the machine has; never throws if it does not tell).
void check_streaming_memory(Index n_patches, std::size_t memory = 0);

}  // namespace radiosity
