#pragma once

#include <memory>

#include "viewer/desk/desk.h"
#include "viewer/desk/look.h"
#include "viewer/work/session.h"

namespace viewer {

/// Whether colours would be the same; the step of an iteration counts, the comparison does not.
bool is_same_look(const Look& a, const Look& b);

/// What the colours were made of, to tell whether they are what they should be.
struct PaintedState {
  Session::Versions versions = {};
  Look look = {};
  bool is_light = false;                          ///< in true colour, whose exposure counts
  std::shared_ptr<const Pinned> subtracted = {};  ///< PaintingTask::subtracted

  /// Whether other colours would come of what the desk has now.
  [[nodiscard]] bool is_stale(const Desk& desk) const;
  /// Whether something else is to be shown, or otherwise; not only other light.
  [[nodiscard]] bool is_other_look(const Desk& desk) const;
};

}  // namespace viewer
