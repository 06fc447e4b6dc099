#pragma once

#include <cstddef>
#include <string>

#include "radiosity/base/geometry.h"
#include "radiosity/base/ranks.h"
#include "radiosity/compressed/make_transport.h"

namespace apps {

/// Bytes that each rank may take, the same on all: what was given (0 = nothing), else the least
/// that any of them has if those on one machine share its memory.
std::size_t memory_of_rank(radiosity::Ranks& ranks, std::size_t given);

/// One line: what a rank is going to take for form factors of so many patches, dense or compressed,
/// at most.
std::string predicted_memory(radiosity::Index n_patches, radiosity::TransportKind kind,
                             int n_ranks);
/// Prints it on stderr, on the first rank.
void tell_memory(radiosity::Index n_patches, radiosity::TransportKind kind,
                 const radiosity::Ranks& ranks);

}  // namespace apps
