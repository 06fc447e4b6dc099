#include "radiosity/base/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cfenv>
#include <chrono>
#include <stdexcept>
#include <thread>

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

}  // namespace
}  // namespace radiosity
