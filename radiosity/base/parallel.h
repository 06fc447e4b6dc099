#pragma once

#include <sys/resource.h>
#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_scheduler_observer.h>
#include <unistd.h>

#include <cstddef>

namespace radiosity {

/// Limits the threads used by everything that follows while it lives. 0 = all cores.
class ThreadLimit {
 public:
  explicit ThreadLimit(std::size_t n_threads)
      : control_(tbb::global_control::max_allowed_parallelism,
                 n_threads > 0 ? n_threads
                               : tbb::global_control::active_value(
                                     tbb::global_control::max_allowed_parallelism)) {}

 private:
  tbb::global_control control_;
};

/// While it lives, the calling thread and those that help it with parallel work run at low
/// priority, so that others (a window) stay responsive even if all cores are busy. A thread's
/// priority cannot be raised again, so use it on a thread of its own.
class LowPriority : private tbb::task_scheduler_observer {
 public:
  LowPriority() {
    lower_this_thread();
    observe(true);
  }
  ~LowPriority() override { observe(false); }
  LowPriority(const LowPriority&) = delete;
  LowPriority& operator=(const LowPriority&) = delete;

 private:
  void on_scheduler_entry(bool /*is_worker*/) override { lower_this_thread(); }
  static void lower_this_thread() {
    constexpr int kLowest = 19;
    // On Linux, a thread's number stands for that thread alone. Failing only costs smoothness.
    setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), kLowest);
  }
};

/// Calls body(i) for i in [0, n), in any order, on all threads. Exceptions reach the caller.
template <typename Body>
void parallel_for(std::ptrdiff_t n, const Body& body, std::ptrdiff_t grain = 1) {
  tbb::parallel_for(tbb::blocked_range<std::ptrdiff_t>(0, n, grain),
                    [&](const tbb::blocked_range<std::ptrdiff_t>& range) {
                      for (std::ptrdiff_t i = range.begin(); i != range.end(); ++i) body(i);
                    });
}

}  // namespace radiosity
