#include "radiosity/base/machine_memory.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <optional>
#include <sstream>
#include <string_view>

namespace radiosity {
namespace {

constexpr double kUsableShare = 0.9;

/// The number after `name` in a file of names and numbers, one pair a line.
std::optional<std::size_t> number_named(const char* path, std::string_view name) {
  std::ifstream file(path);
  std::string found;
  std::size_t number = 0;
  std::string rest;
  while (file >> found >> number && std::getline(file, rest)) {
    if (found == name) return number;
  }
  return std::nullopt;
}

std::optional<std::size_t> machine_memory() {
  const auto kibibytes = number_named("/proc/meminfo", "MemAvailable:");
  if (!kibibytes) return std::nullopt;
  return *kibibytes * 1024;
}

/// The number in a control-group file; empty if there is none ("max", or no such file).
std::optional<std::size_t> number_in(const char* path) {
  std::ifstream file(path);
  std::size_t number = 0;
  if (file >> number) return number;
  return std::nullopt;
}

/// What the control group has left, as a container sees its own group (version 2, then 1). Files
/// that are only cached count as used there, but give way.
std::optional<std::size_t> control_group_memory() {
  auto limit = number_in("/sys/fs/cgroup/memory.max");
  auto used = number_in("/sys/fs/cgroup/memory.current");
  auto cached = number_named("/sys/fs/cgroup/memory.stat", "inactive_file");
  if (!limit) {
    limit = number_in("/sys/fs/cgroup/memory/memory.limit_in_bytes");
    used = number_in("/sys/fs/cgroup/memory/memory.usage_in_bytes");
    cached = number_named("/sys/fs/cgroup/memory/memory.stat", "total_inactive_file");
  }
  if (!limit) return std::nullopt;
  const std::size_t in_use = used.value_or(0) - std::min(used.value_or(0), cached.value_or(0));
  return *limit - std::min(*limit, in_use);
}

}  // namespace

std::size_t usable_memory() {
  const auto machine = machine_memory();
  const auto group = control_group_memory();
  constexpr auto kUnknown = std::numeric_limits<std::size_t>::max();
  const std::size_t available = std::min(machine.value_or(kUnknown), group.value_or(kUnknown));
  if (available == kUnknown) return 0;
  return std::max<std::size_t>(
      1, static_cast<std::size_t>(kUsableShare * static_cast<double>(available)));
}

std::size_t memory_limit(std::size_t memory) {
  if (memory == 0) memory = usable_memory();
  return memory > 0 ? memory : std::numeric_limits<std::size_t>::max();
}

std::string memory_text(std::size_t bytes) {
  const double megabytes = std::ceil(static_cast<double>(bytes) * 1e-6);
  std::ostringstream text;
  text.precision(15);
  if (megabytes < 1000) {
    text << megabytes << "MB";
  } else {
    text << std::ceil(megabytes / 10) / 100 << "GB";
  }
  return text.str();
}

std::string gigabytes(std::size_t bytes) {
  std::ostringstream text;
  text.precision(3);
  text << static_cast<double>(bytes) * 1e-9 << " GB";
  return text.str();
}

}  // namespace radiosity
