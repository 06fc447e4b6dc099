// Reads thousands of damaged files of each format (or of the formats named) and prints what came
// of them: bench/fuzz_readers [MUTANTS [FIRST [FORMAT...]]]. Build it with the preset `debug` to
// have AddressSanitizer and UndefinedBehaviorSanitizer look on. A crash leaves the file in the
// folder that is printed.

#include <sys/resource.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

#include "tests/support/damaged_files.h"
#include "tests/support/reader_fuzz.h"

#if defined(__SANITIZE_ADDRESS__)
// HDF5 asks for what a damaged file says it needs, and copes with not getting it.
extern "C" const char* __asan_default_options() { return "allocator_may_return_null=1"; }
#endif

namespace {

long peak_megabytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss / 1024;
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  const long n = arguments.empty() ? 5000 : std::stol(arguments[0]);
  const std::uint64_t first = arguments.size() > 1 ? std::stoull(arguments[1]) : 0;
  std::vector<std::string> formats(arguments.begin() + std::min<std::size_t>(2, arguments.size()),
                                   arguments.end());
  if (formats.empty()) formats = radiosity::test::fuzz_formats();
  const auto folder =
      std::filesystem::temp_directory_path() / ("fuzz_readers_" + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  std::cout << "files in " << folder << ", mutants " << first << " to " << first + n - 1
            << std::endl;
  [[maybe_unused]] const radiosity::test::LeaksAllowed leaks_of_libraries;
  std::size_t n_faults = 0;
  for (const std::string& format : formats) {
    const auto report = radiosity::test::fuzz_reader(format, first, n, folder);
    for (const std::string& fault : report.faults) std::cout << fault << '\n';
    n_faults += report.faults.size();
    std::cout << format << ": " << report.n_read << " read, " << report.n_refused
              << " refused, slowest " << report.slowest << " s, peak of the process "
              << peak_megabytes() << " MB, " << report.faults.size() << " faults" << std::endl;
  }
  std::filesystem::remove_all(folder);
  return n_faults == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
