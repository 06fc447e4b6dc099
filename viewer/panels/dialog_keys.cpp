#include "viewer/panels/dialog_keys.h"

#include <GLFW/glfw3.h>

namespace viewer {

DialogKeys dialog_keys(std::span<const KeyPress> keys) {
  DialogKeys found;
  for (const KeyPress& press : keys) {
    found.has_enter |= press.key == GLFW_KEY_ENTER || press.key == GLFW_KEY_KP_ENTER;
    found.has_escape |= press.key == GLFW_KEY_ESCAPE;
  }
  return found;
}

}  // namespace viewer
