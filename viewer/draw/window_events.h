#pragma once

#include <array>
#include <deque>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "viewer/desk/key_press.h"

struct GLFWwindow;

namespace viewer {

/// Notes all that happens to a window, and hands mouse and keys over frame by frame, in their
/// order: what lasts less than a frame is not lost, a drag that does is one, and what is typed for
/// a dialog waits until that is there.
class WindowEvents {
 public:
  /// Listens from now on. To be made before ImGui listens, which passes events on.
  explicit WindowEvents(GLFWwindow* window);
  WindowEvents(const WindowEvents&) = delete;
  WindowEvents& operator=(const WindowEvents&) = delete;

  /// Keeps mouse and keys from ImGui until `forward`. To be called when ImGui listens.
  void hold();
  /// Hands ImGui, and `take_keys`, what one frame can take. To be called before each frame, of
  /// ImGui's window before that of ImGui.
  void forward();
  /// To be called between the two: where ImGui looks at the mouse by itself, that is told again.
  void place_mouse() const;
  /// To be called after all that happened has been noted: what comes next is later.
  void end_poll();

  /// Whether anything has happened since the last call, or something still waits.
  bool take_any();
  std::vector<std::string> take_dropped_files();
  /// The scale that another screen asks for, if the window has come to one since the last call.
  std::optional<double> take_screen_scale();
  std::vector<KeyPress> take_keys();

 private:
  /// What the keyboard did, as GLFW tells it.
  struct Key {
    int key = 0;
    int scancode = 0;
    int action = 0;
    int modifiers = 0;
  };
  /// That came of a key.
  struct Letter {
    unsigned code = 0;
  };
  /// Of the mouse, pixels.
  struct Place {
    double x = 0;
    double y = 0;
  };
  struct Button {
    int button = 0;
    int action = 0;
    int modifiers = 0;
    bool is_double = false;  // pressed again at once
  };
  struct Wheel {
    double right = 0;
    double up = 0;
  };
  using Event = std::variant<Key, Letter, Place, Button, Wheel>;
  struct Frame;
  static constexpr int kButtons = 5;

  static WindowEvents& of(GLFWwindow* window);
  void note(const Event& event);
  [[nodiscard]] bool is_again_at_once(int button);
  void forward(const Key& event);
  void forward(const Letter& event);
  void forward(const Place& event);
  void forward(const Button& event);
  void forward(const Wheel& event);

  GLFWwindow* window_;
  std::vector<std::string> dropped_;
  std::optional<double> screen_scale_;
  std::deque<Event> waiting_;
  int waiting_frames_ = 0;  // until anything is handed over again
  std::vector<KeyPress> keys_;
  Place place_;                                // as ImGui has it
  std::array<bool, kButtons> is_down_ = {};    // likewise
  std::array<double, kButtons> pressed_ = {};  // last time of each, s
  double polled_ = 0;                          // until when all had been noted, s
  bool has_any_ = false;
};

}  // namespace viewer
