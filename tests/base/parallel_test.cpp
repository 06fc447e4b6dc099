#include "radiosity/base/parallel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cfenv>
#include <chrono>
#include <stdexcept>
#include <thread>
#include <vector>

namespace radiosity {
namespace {

TEST(ParallelFor, WithinAnotherThatFailsIsDoneOrThrows) {
  // Other threads are within a loop of theirs when the exception ends the outer one.
  for (int attempt = 0; attempt < 10; ++attempt) {
    std::atomic<int> n_unfinished = 0;
    const auto outer = [&](std::ptrdiff_t k) {
      std::atomic<int> n_done = 0;
      parallel_for(50, [&](std::ptrdiff_t i) {
        std::this_thread::sleep_for(std::chrono::microseconds(50));
        if (k == 0 && i == 10) throw std::runtime_error("enough");
        ++n_done;
      });
      if (n_done != 50) ++n_unfinished;
    };
    EXPECT_THROW(parallel_for(8, outer), std::runtime_error);
    EXPECT_EQ(n_unfinished, 0);
  }
}

// Whoever was the first to use TBB, and however that one rounded.
TEST(ParallelFor, RoundsAsItsCallerDoes) {
  const int before = std::fegetround();
  for (const int mode : {FE_UPWARD, FE_TONEAREST, FE_DOWNWARD}) {
    std::fesetround(mode);
    std::atomic<int> n_other = 0;
    parallel_for(1000, [&](std::ptrdiff_t) {
      if (std::fegetround() != mode) ++n_other;
    });
    std::fesetround(before);
    EXPECT_EQ(n_other, 0) << mode;
  }
}

TEST(ParallelSum, HasTheSameBitsAtAnyNumberOfThreads) {
  for (const std::ptrdiff_t n : {0L, 1L, 8191L, 8192L, 8193L, 100000L}) {
    const auto sum = [&] {
      return parallel_sum(n, 0.0, [](std::ptrdiff_t begin, std::ptrdiff_t length) {
        double part = 0;
        for (std::ptrdiff_t i = begin; i < begin + length; ++i) {
          part += 1 / (1 + static_cast<double>(i));
        }
        return part;
      });
    };
    double expected = 0;
    {
      const ThreadLimit one(1);
      expected = sum();
    }
    double plain = 0;
    for (std::ptrdiff_t i = n - 1; i >= 0; --i) plain += 1 / (1 + static_cast<double>(i));
    EXPECT_NEAR(expected, plain, 1e-12) << n;
    for (const std::size_t n_threads : {2U, 3U}) {
      const ThreadLimit limit(n_threads);
      EXPECT_EQ(sum(), expected) << n;
    }
  }
}

TEST(ParallelSegments, MakeUpAll) {
  for (const std::ptrdiff_t n : {0L, 1L, 8192L, 20000L}) {
    std::vector<int> visits(static_cast<std::size_t>(n), 0);
    parallel_segments(n, [&](std::ptrdiff_t begin, std::ptrdiff_t length) {
      for (std::ptrdiff_t i = begin; i < begin + length; ++i) ++visits[static_cast<std::size_t>(i)];
    });
    EXPECT_EQ(std::count(visits.begin(), visits.end(), 1), n);
  }
}

}  // namespace
}  // namespace radiosity
