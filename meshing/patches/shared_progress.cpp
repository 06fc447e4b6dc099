#include "meshing/patches/shared_progress.h"

#include <algorithm>
#include <string_view>
#include <utility>

namespace meshing {

SharedProgress::SharedProgress(const radiosity::Progress& progress, std::string stage, double total,
                               std::string unit)
    : progress_(progress), stage_(std::move(stage)), total_(total), unit_(std::move(unit)) {}

void SharedProgress::add(double done) {
  if (!progress_.report || done == 0) return;
  const std::lock_guard lock(mutex_);
  done_ += done;
  progress_.report(stage_, std::min(done_, total_), total_, unit_);
}

radiosity::Progress SharedProgress::part(double weight) {
  radiosity::Progress result{.report = {}, .stop = progress_.stop};
  if (!progress_.report) return result;
  result.report = [this, weight, told = 0.0](std::string_view, double done, double,
                                             std::string_view) mutable {
    add(weight * (done - told));
    told = done;
  };
  return result;
}

}  // namespace meshing
