#pragma once

#include <cstddef>
#include <functional>
#include <memory>

namespace radiosity {

/// Limits the threads used by everything that follows while it lives. 0 = all cores.
class ThreadLimit {
 public:
  explicit ThreadLimit(std::size_t n_threads);
  ~ThreadLimit();
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

/// While it lives, the calling thread and those that help it with parallel work run at low
/// priority, so that others (a window) stay responsive even if all cores are busy. A thread's
/// priority cannot be raised again, so use it on a thread of its own.
class LowPriority {
 public:
  LowPriority();
  ~LowPriority();
  LowPriority(const LowPriority&) = delete;
  LowPriority& operator=(const LowPriority&) = delete;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

/// Calls body(begin, end) for ranges that make up [0, n), in any order, on all threads. Ranges of
/// at most `grain` are not divided further. Exceptions reach the caller.
void parallel_ranges(std::ptrdiff_t n, std::ptrdiff_t grain,
                     const std::function<void(std::ptrdiff_t, std::ptrdiff_t)>& body);

/// Calls body(i) for i in [0, n), in any order, on all threads. Exceptions reach the caller.
template <typename Body>
void parallel_for(std::ptrdiff_t n, const Body& body, std::ptrdiff_t grain = 1) {
  parallel_ranges(n, grain, [&body](std::ptrdiff_t begin, std::ptrdiff_t end) {
    for (std::ptrdiff_t i = begin; i != end; ++i) body(i);
  });
}

}  // namespace radiosity
