#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace apps {

/// How a process ended.
struct ProcessEnd {
  int exit_code = 0;              ///< -signal if a signal ended it
  double seconds = 0;             ///< since it was started
  std::uint64_t peak_memory = 0;  ///< resident, bytes
};

/// This program once more, in a process and a process group of its own, so that the terminal's
/// Ctrl-C does not reach it. It is asked to stop if this process ends, and ended with this object.
class ChildProcess {
 public:
  /// Starts it with these arguments in a folder; stdout and stderr go to files. Throws OutputError
  /// if the system does not allow another process.
  ChildProcess(const std::vector<std::string>& arguments, const std::filesystem::path& folder,
               const std::filesystem::path& out, const std::filesystem::path& err);
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// How it ended, if it has. Does not wait.
  [[nodiscard]] std::optional<ProcessEnd> poll();
  /// Asks it to stop.
  void stop() const;
  /// Ends it at once.
  void kill() const;

 private:
  pid_t pid_ = 0;
  std::optional<ProcessEnd> end_;
  std::chrono::steady_clock::time_point start_;
};

}  // namespace apps
