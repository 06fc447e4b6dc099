#pragma once

#include <deque>
#include <string>
#include <vector>

#include "viewer/desk/key_press.h"

struct GLFWwindow;

namespace viewer {

/// Notes all that happens to a window, and hands keys over frame by frame: what lasts less than a
/// frame is not lost, and what is typed for a dialog waits until that is there.
class WindowEvents {
 public:
  /// Listens from now on. To be made before ImGui listens, which passes events on.
  explicit WindowEvents(GLFWwindow* window);
  WindowEvents(const WindowEvents&) = delete;
  WindowEvents& operator=(const WindowEvents&) = delete;

  /// Keeps keys from ImGui until `forward_keys`. To be called when ImGui listens.
  void hold_keys();
  /// Hands ImGui, and `take_keys`, what one frame can take of the keys. To be called before each.
  void forward_keys();

  /// Whether anything has happened since the last call, or keys still wait.
  bool take_any();
  std::vector<std::string> take_dropped_files();
  std::vector<KeyPress> take_keys();

 private:
  /// What the keyboard did, as GLFW tells it: to a key, or a letter that came of it.
  struct KeyEvent {
    int key = 0;
    int scancode = 0;
    int action = 0;
    int modifiers = 0;
    unsigned letter = 0;  // else 0
  };
  static WindowEvents& of(GLFWwindow* window);
  void forward(const KeyEvent& event);

  GLFWwindow* window_;
  std::vector<std::string> dropped_;
  std::deque<KeyEvent> waiting_;
  int waiting_frames_ = 0;  // until keys are handed over again
  std::vector<KeyPress> keys_;
  bool has_any_ = false;
};

}  // namespace viewer
