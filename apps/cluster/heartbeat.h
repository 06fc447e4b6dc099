#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

namespace apps {

/// What a rank is at, for those that wait for it.
struct RankActivity {
  std::atomic<std::uint64_t> messages = 0;  ///< that it has sent or got
  std::atomic<int> waiting = 0;             ///< threads that wait for one
  std::atomic<std::int64_t> idle = 0;  ///< ns of processor time spent on looking for one in vain
};

/// Processor time of the calling thread, ns.
std::int64_t thread_time();

/// Lets ranks tell each other that they are alive and get on, by MPI and a thread of its own.
/// A rank gets on if it sends or gets messages, or works or writes while it does not wait.
class Heartbeat {
 public:
  /// Of all ranks together, after MPI has begun. `lost` is called on that thread, once, with one
  /// line that tells which rank is lost; it shall end them all.
  Heartbeat(const RankActivity& activity, std::chrono::duration<double> patience,
            std::function<void(const std::string& line)> lost);
  /// Before MPI ends; all ranks have come to their end.
  ~Heartbeat();
  Heartbeat(const Heartbeat&) = delete;
  Heartbeat& operator=(const Heartbeat&) = delete;

  /// How long a rank may be silent and all may stand still; 0: for ever.
  void set_patience(std::chrono::duration<double> patience);

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace apps
