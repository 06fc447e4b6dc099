#include "viewer/work/mix_history.h"

#include <utility>

namespace viewer {
namespace {

constexpr std::size_t kMostSteps = 100;

LightMix take_last(std::vector<LightMix>& mixes) {
  LightMix mix = std::move(mixes.back());
  mixes.pop_back();
  return mix;
}

}  // namespace

void MixHistory::note(const Item& item, const LightMix& mix) {
  undone_.clear();
  const bool goes_on = !is_step_due_ && item == latest_ && !done_.empty();
  is_step_due_ = false;
  latest_ = item;
  if (goes_on) return;
  if (done_.size() == kMostSteps) done_.erase(done_.begin());
  done_.push_back(mix);
}

LightMix MixHistory::undo(LightMix now) {
  is_step_due_ = true;
  undone_.push_back(std::move(now));
  return take_last(done_);
}

LightMix MixHistory::redo(LightMix now) {
  is_step_due_ = true;
  done_.push_back(std::move(now));
  return take_last(undone_);
}

void MixHistory::clear() {
  done_.clear();
  undone_.clear();
  is_step_due_ = true;
}

}  // namespace viewer
