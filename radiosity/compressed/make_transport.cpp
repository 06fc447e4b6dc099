#include "radiosity/compressed/make_transport.h"

#include <algorithm>
#include <string>

#include "radiosity/assembly/dense_memory.h"
#include "radiosity/assembly/make_dense_transport.h"
#include "radiosity/base/error.h"
#include "radiosity/base/machine_memory.h"

namespace radiosity {
namespace {

std::string way_out(Index fits, Index n_polygons) {
  if (n_polygons < fits) return "use --patches " + std::to_string(fits);
  return "use a scene of fewer polygons (at most about " + std::to_string(fits) + "; it has " +
         std::to_string(n_polygons) + ")";
}

/// Refuses what fits neither way.
[[noreturn]] void refuse_both(Index n_patches, Index n_polygons, std::size_t limit) {
  const auto compressed = static_cast<Index>(limit / compressed_transport_bytes(1));
  throw MemoryShortage(
      "the form factors of " + std::to_string(n_patches) + " patches need " +
      gigabytes(dense_transport_bytes(n_patches)) + " of memory, or some " +
      gigabytes(compressed_transport_bytes(n_patches)) + " compressed, but " + gigabytes(limit) +
      " can be used: " + way_out(std::max(largest_problem(limit), compressed), n_polygons));
}

void check_rows_memory(Index n_patches, Index n_polygons, std::size_t limit) {
  if (dense_transport_bytes(n_patches) <= limit) return;
  throw MemoryShortage("this method goes by rows of all form factors, which for " +
                       std::to_string(n_patches) + " patches need " +
                       gigabytes(dense_transport_bytes(n_patches)) + " of memory, but " +
                       gigabytes(limit) + " can be used: use --method cg, which needs none, or " +
                       way_out(largest_problem(limit), n_polygons).substr(4));
}

}  // namespace

TransportKind chosen_kind(const TransportChoice& choice, Index n_patches, double tolerance,
                          std::size_t memory) {
  if (choice.kind != TransportKind::automatic) return choice.kind;
  if (choice.by_rows) return TransportKind::dense;
  const bool fits = dense_transport_bytes(n_patches) / choice.n_ranks <= memory_limit(memory);
  const bool is_wanted = n_patches <= kMostDense || tolerance < kLeastCompressed;
  return fits && is_wanted ? TransportKind::dense : TransportKind::compressed;
}

void check_choice(const TransportChoice& choice, Index n_patches, Index n_polygons,
                  double tolerance, std::size_t memory) {
  const std::size_t limit = memory_limit(memory);
  switch (choice.kind) {
    case TransportKind::dense:
      return check_memory(n_patches, n_polygons, memory, choice.n_ranks);
    case TransportKind::compressed:
      if (choice.by_rows) {
        throw SolveError(
            "this method goes by rows, of which each takes a product with a compressed operator: "
            "use --transport dense or auto, or --method cg");
      }
      return check_compressed_memory(n_patches, memory);
    case TransportKind::automatic:
      if (choice.by_rows) return check_rows_memory(n_patches, n_polygons, limit);
      if (chosen_kind(choice, n_patches, tolerance, memory) == TransportKind::compressed &&
          compressed_transport_bytes(n_patches) > limit) {
        refuse_both(n_patches, n_polygons, limit);
      }
  }
}

std::unique_ptr<Transport> make_transport(const PatchMesh& mesh, const Visibility& visibility,
                                          const TransportOptions& options,
                                          const TransportChoice& choice,
                                          const ExpectedLight& light) {
  if (!mesh.images.empty()) {
    if (choice.kind == TransportKind::compressed) refuse_compressed_part();
    return make_dense_transport(mesh, visibility, options);
  }
  check_choice(choice, mesh.size(), mesh.n_polygons(), options.tolerance, options.memory);
  if (chosen_kind(choice, mesh.size(), options.tolerance, options.memory) == TransportKind::dense) {
    return make_dense_transport(mesh, visibility, options);
  }
  return make_compressed_transport(mesh, visibility, options, light);
}

}  // namespace radiosity
