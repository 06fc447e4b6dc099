#include "apps/run/available_memory.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <optional>
#include <string>

#include "apps/terminal/memory_size.h"
#include "radiosity/assembly/make_transport.h"
#include "radiosity/base/error.h"
#include "radiosity/stream/streamed_factors.h"

namespace apps {
namespace {

using radiosity::Index;

constexpr double kUsableShare = 0.9;
/// For streaming if the system does not tell what it has, bytes.
constexpr std::size_t kModestMemory = 1'000'000'000;

std::optional<std::size_t> machine_memory() {
  std::ifstream file("/proc/meminfo");
  std::string name;
  std::size_t kibibytes = 0;
  std::string rest;
  while (file >> name >> kibibytes && std::getline(file, rest)) {
    if (name == "MemAvailable:") return kibibytes * 1024;
  }
  return std::nullopt;
}

/// The number in a control-group file; empty if there is none ("max", or no such file).
std::optional<std::size_t> number_in(const char* path) {
  std::ifstream file(path);
  std::size_t number = 0;
  if (file >> number) return number;
  return std::nullopt;
}

/// What the control group has left, as a container sees its own group (version 2, then 1).
std::optional<std::size_t> control_group_memory() {
  auto limit = number_in("/sys/fs/cgroup/memory.max");
  auto used = number_in("/sys/fs/cgroup/memory.current");
  if (!limit) {
    limit = number_in("/sys/fs/cgroup/memory/memory.limit_in_bytes");
    used = number_in("/sys/fs/cgroup/memory/memory.usage_in_bytes");
  }
  if (!limit) return std::nullopt;
  return *limit - std::min(*limit, used.value_or(0));
}

std::string gigabytes(std::size_t bytes) {
  return fmt::format("{:.3g} GB", static_cast<double>(bytes) * 1e-9);
}

}  // namespace

std::size_t usable_memory() {
  const auto machine = machine_memory();
  const auto group = control_group_memory();
  constexpr auto kUnknown = std::numeric_limits<std::size_t>::max();
  const std::size_t available = std::min(machine.value_or(kUnknown), group.value_or(kUnknown));
  if (available == kUnknown) return 0;
  return static_cast<std::size_t>(kUsableShare * static_cast<double>(available));
}

Index largest_problem(std::size_t bytes) {
  Index fits = 0;
  Index too_large = Index{1} << 31;  // operators index patches with 32 bits
  while (too_large - fits > 1) {
    const Index middle = fits + (too_large - fits) / 2;
    (radiosity::dense_transport_bytes(middle) <= bytes ? fits : too_large) = middle;
  }
  if (fits < 10) return 0;
  const auto unit = static_cast<Index>(std::pow(10.0, std::floor(std::log10(fits)) - 1));
  return fits / unit * unit;
}

void check_memory(Index n_patches, Index n_polygons, std::size_t memory) {
  const std::size_t needed = radiosity::dense_transport_bytes(n_patches);
  if (memory == 0 || needed <= memory) return;
  const Index fits = largest_problem(memory);
  const std::string way_out =
      n_polygons < fits ? fmt::format("use --patches {}", fits)
                        : fmt::format("use a scene of fewer polygons (at most about {}; it has {})",
                                      fits, n_polygons);
  throw radiosity::SolveError(
      fmt::format("the form factors of {} patches need {} of memory, but {} can be used: {}",
                  n_patches, gigabytes(needed), gigabytes(memory), way_out));
}

std::size_t default_streaming_memory() {
  const std::size_t usable = usable_memory();
  return usable > 0 ? usable / 2 : kModestMemory;
}

void check_streaming_memory(Index n_patches, std::size_t memory) {
  const std::size_t needed =
      radiosity::streaming_memory(n_patches) + radiosity::least_buffers(n_patches);
  if (memory == 0 || needed <= memory) return;
  throw radiosity::SolveError(
      fmt::format("the form factors of {} patches need at least {} of memory, but {} may be used: "
                  "use --memory {} or fewer patches",
                  n_patches, memory_text(needed), memory_text(memory), memory_text(needed)));
}

}  // namespace apps
