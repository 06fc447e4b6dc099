#include "apps/run/rank_memory.h"

#include <fmt/format.h>

#include <cstdio>
#include <limits>

#include "radiosity/assembly/dense_memory.h"
#include "radiosity/base/machine_memory.h"
#include "radiosity/stream/streaming_memory.h"

namespace apps {

std::size_t memory_of_rank(radiosity::Ranks& ranks, std::size_t given) {
  std::size_t own = given;
  if (own == 0) own = radiosity::usable_memory() / static_cast<std::size_t>(ranks.n_on_machine());
  if (own == 0) own = std::numeric_limits<std::size_t>::max();
  return radiosity::least_of_ranks(ranks, own);
}

std::string predicted_memory(radiosity::Index n_patches, radiosity::TransportKind kind,
                             int n_ranks) {
  if (kind == radiosity::TransportKind::compressed) {
    const std::size_t all = radiosity::compressed_transport_bytes(n_patches);
    return fmt::format("{} ranks, each takes {} at most for {} patches and its form factors",
                       n_ranks, radiosity::gigabytes(all), n_patches);
  }
  const std::size_t patches = radiosity::streaming_memory(n_patches);
  const std::size_t factors = radiosity::dense_transport_bytes(n_patches) / n_ranks;
  return fmt::format("{} ranks, each takes {} at most: {} for {} patches, {} for its form factors",
                     n_ranks, radiosity::gigabytes(patches + factors),
                     radiosity::gigabytes(patches), n_patches, radiosity::gigabytes(factors));
}

void tell_memory(radiosity::Index n_patches, radiosity::TransportKind kind,
                 const radiosity::Ranks& ranks) {
  if (ranks.rank() > 0) return;
  fmt::print(stderr, "radiosity-mpi: {}\n", predicted_memory(n_patches, kind, ranks.size()));
}

}  // namespace apps
