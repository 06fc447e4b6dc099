#include "radiosity/assembly/dense_memory.h"

#include <cmath>
#include <string>

#include "radiosity/base/error.h"
#include "radiosity/base/machine_memory.h"

namespace radiosity {
std::size_t dense_transport_bytes(Index n_patches) {
  const auto n = static_cast<double>(n_patches);
  return static_cast<std::size_t>(2.4 * n * n);
}

Index largest_problem(std::size_t memory) {
  const std::size_t limit = memory_limit(memory);
  Index fits = 0;
  Index too_large = Index{1} << 31;  // operators index patches with 32 bits
  while (too_large - fits > 1) {
    const Index middle = fits + (too_large - fits) / 2;
    (dense_transport_bytes(middle) <= limit ? fits : too_large) = middle;
  }
  if (fits < 10) return 0;
  const auto unit = static_cast<Index>(std::pow(10.0, std::floor(std::log10(fits)) - 1));
  return fits / unit * unit;
}

void check_memory(Index n_patches, Index n_polygons, std::size_t memory, int n_ranks) {
  const std::size_t limit = memory_limit(memory);
  const std::size_t needed = dense_transport_bytes(n_patches) / n_ranks;
  if (needed <= limit) return;
  const Index fits = largest_problem(limit * n_ranks);
  const std::string way_out =
      n_polygons < fits
          ? "use --patches " + std::to_string(fits) + " or, for more, --transport compressed"
          : "use a scene of fewer polygons (at most about " + std::to_string(fits) + "; it has " +
                std::to_string(n_polygons) + ")";
  throw MemoryShortage("the form factors of " + std::to_string(n_patches) + " patches need " +
                       gigabytes(needed) + " of memory" +
                       (n_ranks > 1 ? " on each of " + std::to_string(n_ranks) + " ranks" : "") +
                       ", but " + gigabytes(limit) + " can be used: " + way_out);
}

}  // namespace radiosity
