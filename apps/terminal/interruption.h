#pragma once

#include <atomic>
#include <mutex>
#include <stop_token>
#include <string>
#include <thread>

namespace apps {

/// Exit code of a program that was interrupted.
inline constexpr int kInterruptedExit = 130;

/// Turns SIGINT and SIGTERM into a stop request. Make one, at the start of `main`, before any other
/// thread exists. Work that has not ended within a second of the first signal is cut off with
/// exit code 130; a second signal does so at once.
class Interruption {
 public:
  Interruption();
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;

  /// Requested by the first signal.
  [[nodiscard]] std::stop_token token() const { return source_.get_token(); }

  /// While the lock lives, a single signal does not cut the program off: hold it to write a file.
  [[nodiscard]] std::unique_lock<std::mutex> hold() { return std::unique_lock(writing_); }

  /// Has `line` told on stderr if the program gets interrupted from now on: how to go on, say.
  void advise(const std::string& line);
  /// Tells on stderr that the program was interrupted, and the advice.
  void tell();

 private:
  void watch();

  std::stop_source source_;
  std::mutex writing_;
  std::mutex telling_;  // guards the message
  std::string message_ = "radiosity: interrupted\n";
  std::atomic<bool> finished_ = false;
  std::thread watcher_;
};

}  // namespace apps
