#pragma once

#include <cstddef>
#include <vector>

#include "viewer/work/light_mix.h"

namespace viewer {

/// Steps back and forth between mixes. A step is all that is changed of one lamp, material or the
/// daylight until `begin_step`: one drag of a slider, say. The latest hundred are kept.
class MixHistory {
 public:
  /// What is changed.
  struct Item {
    enum class Kind { emitter, material, daylight, all };
    Kind kind = Kind::all;
    std::size_t index = 0;
    friend bool operator==(const Item&, const Item&) = default;
  };

  /// The next change is a step of its own, whatever it is of.
  void begin_step() { is_step_due_ = true; }
  /// Notes a mix that is about to be changed. What was undone cannot be had again after that.
  void note(const Item& item, const LightMix& mix);
  [[nodiscard]] bool can_undo() const { return !done_.empty(); }
  [[nodiscard]] bool can_redo() const { return !undone_.empty(); }
  /// The mix before the latest step, which there must be; `now` is kept for `redo`.
  LightMix undo(LightMix now);
  /// The mix before the latest `undo`, which there must be.
  LightMix redo(LightMix now);
  void clear();

 private:
  std::vector<LightMix> done_;    // before each step
  std::vector<LightMix> undone_;  // after each step that was undone, the latest last
  Item latest_;
  bool is_step_due_ = true;
};

}  // namespace viewer
