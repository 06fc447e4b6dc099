#pragma once

#include <mutex>
#include <stop_token>
#include <string>

#include "radiosity/base/progress.h"

namespace meshing {

/// Adds up what several threads have done of one stage, and tells it. Outlives its parts.
class SharedProgress {
 public:
  /// `total` may be a guess: no more than that is ever told as done.
  SharedProgress(const radiosity::Progress& progress, std::string stage, double total,
                 std::string unit);

  /// So much more is done. From any thread.
  void add(double done);
  /// For one thread's part: what that reports as done so far counts `weight` times for the whole.
  [[nodiscard]] radiosity::Progress part(double weight);
  /// Throws Interrupted if stopping was requested.
  void check() const { progress_.check(); }
  [[nodiscard]] const std::stop_token& stop() const { return progress_.stop; }

 private:
  const radiosity::Progress& progress_;
  std::string stage_;
  double total_;
  std::string unit_;
  std::mutex mutex_;
  double done_ = 0;
};

}  // namespace meshing
