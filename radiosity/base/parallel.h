#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

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

/// Things that are summed together, so that the order of sums is fixed.
inline constexpr std::ptrdiff_t kSumPart = 8192;

/// Σ sum(begin, n) over ranges [begin, begin + n) that make up [0, n_all), `zero` if there are
/// none: worked out on all threads, added in their order, the same bits at any number of threads.
template <typename Value, typename Sum>
Value parallel_sum(std::ptrdiff_t n_all, Value zero, const Sum& sum) {
  const std::ptrdiff_t n_parts = (n_all + kSumPart - 1) / kSumPart;
  std::vector<Value> sums(static_cast<std::size_t>(n_parts), zero);
  parallel_for(n_parts, [&](std::ptrdiff_t part) {
    const std::ptrdiff_t begin = part * kSumPart;
    sums[static_cast<std::size_t>(part)] = sum(begin, std::min(kSumPart, n_all - begin));
  });
  for (const Value& part : sums) zero += part;
  return zero;
}

/// Calls body(begin, n) for ranges [begin, begin + n) that make up [0, n_all) and stay in a cache,
/// in any order, on all threads: what is worked out with arrays there needs no temporary ones.
template <typename Body>
void parallel_segments(std::ptrdiff_t n_all, const Body& body) {
  parallel_for((n_all + kSumPart - 1) / kSumPart, [&](std::ptrdiff_t part) {
    const std::ptrdiff_t begin = part * kSumPart;
    body(begin, std::min(kSumPart, n_all - begin));
  });
}

}  // namespace radiosity
