#include "radiosity/stream/streaming_memory.h"

#include <cstdint>
#include <string>

#include "radiosity/assembly/tile_sum.h"
#include "radiosity/base/error.h"
#include "radiosity/base/machine_memory.h"
#include "radiosity/stream/row_stream.h"

namespace radiosity {
namespace {

/// The program with its libraries, and one patch with its share of tree and ray tracer, bytes.
constexpr double kProgramBytes = 96e6;
constexpr double kPatchBytes = 5e3;
/// Strips have at least this many rows, but for the last levels of small trees.
constexpr double kLeastStripRows = 32;
constexpr std::size_t kLeastRows = 16;
/// If the system does not tell what it has, bytes.
constexpr std::size_t kModestMemory = 1'000'000'000;

}  // namespace

std::size_t streaming_memory(Index n_patches) {
  const auto n = static_cast<double>(n_patches);
  const double n_strips = n / kLeastStripRows + 1;
  const double index = 0.5 * n_strips * (n_strips + 1) * sizeof(std::uint64_t);
  const double sums = kSumParts * n * sizeof(double);
  return static_cast<std::size_t>(kProgramBytes + kPatchBytes * n + index + sums);
}

std::size_t least_buffers(Index n_patches) { return kLeastRows * row_bytes(n_patches); }

std::size_t default_streaming_memory() {
  const std::size_t usable = usable_memory();
  return usable > 0 ? usable / 2 : kModestMemory;
}

void check_streaming_memory(Index n_patches, std::size_t memory) {
  const std::size_t needed = streaming_memory(n_patches) + least_buffers(n_patches);
  memory = memory_limit(memory);
  if (needed <= memory) return;
  throw MemoryShortage("the form factors of " + std::to_string(n_patches) +
                       " patches need at least " + memory_text(needed) + " of memory, but " +
                       memory_text(memory) + " may be used: use --memory " + memory_text(needed) +
                       " or fewer patches");
}

}  // namespace radiosity
