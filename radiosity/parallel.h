#pragma once

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

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

/// Calls body(i) for i in [0, n), in any order, on all threads. Exceptions reach the caller.
template <typename Body>
void parallel_for(std::ptrdiff_t n, const Body& body, std::ptrdiff_t grain = 1) {
  tbb::parallel_for(tbb::blocked_range<std::ptrdiff_t>(0, n, grain),
                    [&](const tbb::blocked_range<std::ptrdiff_t>& range) {
                      for (std::ptrdiff_t i = range.begin(); i != range.end(); ++i) body(i);
                    });
}

}  // namespace radiosity
