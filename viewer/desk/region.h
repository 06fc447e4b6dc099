#pragma once

namespace viewer {

/// Where something is drawn, in pixels of the window from its top left.
struct Region {
  int left = 0;
  int top = 0;
  int width = 0;
  int height = 0;

  friend bool operator==(const Region&, const Region&) = default;
};

}  // namespace viewer
