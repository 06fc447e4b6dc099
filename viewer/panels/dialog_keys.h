#pragma once

#include <span>

#include "viewer/desk/key_press.h"

namespace viewer {

/// What every dialog understands.
struct DialogKeys {
  bool has_enter = false;
  bool has_escape = false;
};

DialogKeys dialog_keys(std::span<const KeyPress> keys);

}  // namespace viewer
