#include "apps/terminal/machine.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/utsname.h>
#if defined(__GLIBC__)
#include <malloc.h>
#endif

#include <ctime>
#include <fstream>
#include <thread>

namespace apps {
namespace {

std::string processor() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    if (line.rfind("model name", 0) != 0) continue;
    const auto colon = line.find(": ");
    if (colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown processor";
}

}  // namespace

std::string machine_text() {
  utsname system{};
  const bool is_known = ::uname(&system) == 0;
  return fmt::format("{}, {} threads, {}", processor(), std::thread::hardware_concurrency(),
                     is_known
                         ? fmt::format("{} {} {}", system.sysname, system.release, system.machine)
                         : "unknown system");
}

std::string time_text() {
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
}

void keep_freed_memory() {
#if defined(__GLIBC__)
  constexpr int kLargest = 256 << 20;
  ::mallopt(M_MMAP_THRESHOLD, kLargest);
  ::mallopt(M_TRIM_THRESHOLD, 2 * kLargest);
#endif
}

}  // namespace apps
