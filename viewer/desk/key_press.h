#pragma once

namespace viewer {

/// A key that was pressed, or that the keyboard repeats while it is held.
struct KeyPress {
  int key = 0;  ///< as GLFW counts them; letters by what is printed on the key
  bool has_control = false;
  bool has_shift = false;
};

}  // namespace viewer
