#include "viewer/draw/window_events.h"

#include <GLFW/glfw3.h>
#include <imgui.h>
#include <imgui_impl_glfw.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <set>
#include <string_view>
#include <utility>

namespace viewer {
namespace {

/// The key that bears the letter, as the user's keyboard has it; plus and minus likewise.
int lettered_key(int key, int scancode) {
  const char* name = glfwGetKeyName(key, scancode);
  if (name != nullptr && std::string_view("+") == name) return GLFW_KEY_EQUAL;
  if (name != nullptr && std::string_view("-") == name) return GLFW_KEY_MINUS;
  const bool is_letter = name != nullptr && name[0] >= 'a' && name[0] <= 'z' && name[1] == '\0';
  return is_letter ? GLFW_KEY_A + (name[0] - 'a') : key;
}

/// Frames after which a dialog that a key has opened or closed takes letters.
constexpr int kDialogFrames = 3;

bool may_open_dialog(int key, int modifiers) {
  return (modifiers & GLFW_MOD_CONTROL) != 0 || key == GLFW_KEY_ENTER || key == GLFW_KEY_KP_ENTER ||
         key == GLFW_KEY_ESCAPE;
}

constexpr double kDoubleClick = 0.3;                            // seconds between presses, at most
constexpr float kAnyTime = 1e9F;                                // s
constexpr float kNowhere = -std::numeric_limits<float>::max();  // where ImGui has no mouse

bool is_any_down(GLFWwindow* window) {
  for (int button = GLFW_MOUSE_BUTTON_1; button <= GLFW_MOUSE_BUTTON_LAST; ++button) {
    if (glfwGetMouseButton(window, button) != GLFW_RELEASE) return true;
  }
  return false;
}

}  // namespace

WindowEvents& WindowEvents::of(GLFWwindow* window) {
  return *static_cast<WindowEvents*>(glfwGetWindowUserPointer(window));
}

/// What a frame has been given.
struct WindowEvents::Frame {
  std::set<int> pressed;  // keys
  bool has_keys = false;
  bool has_button = false;
  bool has_wheel = false;
  bool has_moved = false;

  // A dialog or a field that a button opens takes letters from the next frame on.
  [[nodiscard]] bool fits(const Letter& /*event*/) const { return !has_button && !has_wheel; }
  // ImGui looks once a frame at keys that give no letter: it would not see one that is up again.
  [[nodiscard]] bool fits(const Key& event) const {
    const bool is_over = event.action == GLFW_RELEASE && pressed.contains(event.key);
    return !has_button && !has_wheel && !is_over;
  }
  // Buttons and the wheel act where the mouse is.
  [[nodiscard]] bool fits(const Place& /*event*/) const { return !has_button && !has_wheel; }
  // Whoever drags something looks where it is while it is held, and no more once it is let go.
  [[nodiscard]] bool fits(const Button& event) const {
    const bool ends_drag = event.action == GLFW_RELEASE && has_moved;
    return !has_keys && !has_button && !has_wheel && !ends_drag;
  }
  [[nodiscard]] bool fits(const Wheel& /*event*/) const { return !has_keys && !has_button; }

  void note(const Letter& /*event*/) { has_keys = true; }
  void note(const Key& event) {
    has_keys = true;
    const bool has_letter = event.key < GLFW_KEY_ESCAPE;
    if (event.action != GLFW_RELEASE && !has_letter) pressed.insert(event.key);
  }
  void note(const Place& /*event*/) { has_moved = true; }
  void note(const Button& /*event*/) { has_button = true; }
  void note(const Wheel& /*event*/) { has_wheel = true; }
};

WindowEvents::WindowEvents(GLFWwindow* window) : window_(window), place_{kNowhere, kNowhere} {
  glfwSetWindowUserPointer(window, this);
  pressed_.fill(-kAnyTime);
  glfwSetDropCallback(window, [](GLFWwindow* source, int n, const char** paths) {
    of(source).dropped_.insert(of(source).dropped_.end(), paths, paths + n);
    of(source).has_any_ = true;
  });
  glfwSetCursorEnterCallback(window, [](GLFWwindow* source, int is_inside) {
    of(source).has_any_ = true;
    // What is dragged beyond the edge is still held.
    if (is_inside == GLFW_FALSE && !is_any_down(source)) of(source).note(Place{kNowhere, kNowhere});
  });
  glfwSetWindowContentScaleCallback(window, [](GLFWwindow* source, float scale, float) {
    of(source).screen_scale_ = scale;
    of(source).has_any_ = true;
  });
  const auto note_window = [](GLFWwindow* source) { of(source).has_any_ = true; };
  glfwSetWindowRefreshCallback(window, note_window);
  glfwSetWindowCloseCallback(window, note_window);
  glfwSetFramebufferSizeCallback(window,
                                 [](GLFWwindow* source, int, int) { of(source).has_any_ = true; });
}

void WindowEvents::hold() {
  glfwSetKeyCallback(window_, [](GLFWwindow* source, int key, int scancode, int action, int mods) {
    of(source).note(Key{key, scancode, action, mods});
  });
  glfwSetCharCallback(window_,
                      [](GLFWwindow* source, unsigned letter) { of(source).note(Letter{letter}); });
  glfwSetCursorPosCallback(window_, [](GLFWwindow* source, double x, double y) {
    of(source).note(Place{x, y});
  });
  glfwSetScrollCallback(window_, [](GLFWwindow* source, double right, double up) {
    of(source).note(Wheel{right, up});
  });
  glfwSetMouseButtonCallback(window_, [](GLFWwindow* source, int button, int action, int mods) {
    if (button >= kButtons) return;
    const bool is_double = action == GLFW_PRESS && of(source).is_again_at_once(button);
    of(source).note(Button{button, action, mods, is_double});
  });
}

void WindowEvents::note(const Event& event) {
  // Where the mouse has been in between does not matter.
  const bool has_moved_on = !waiting_.empty() && std::holds_alternative<Place>(waiting_.back()) &&
                            std::holds_alternative<Place>(event);
  if (has_moved_on) waiting_.pop_back();
  waiting_.push_back(event);
}

/// Notes that a button was pressed. It can have been at any time since all had been noted last,
/// which may be long ago where frames are slow: whether it can have been at once after the last
/// time.
bool WindowEvents::is_again_at_once(int button) {
  const double last = std::exchange(pressed_.at(button), glfwGetTime());
  return polled_ - last < kDoubleClick;
}

void WindowEvents::end_poll() { polled_ = glfwGetTime(); }

void WindowEvents::forward(const Key& event) {
  ImGui_ImplGlfw_KeyCallback(window_, event.key, event.scancode, event.action, event.modifiers);
  if (event.action == GLFW_RELEASE) return;
  keys_.push_back({.key = lettered_key(event.key, event.scancode),
                   .has_control = (event.modifiers & GLFW_MOD_CONTROL) != 0,
                   .has_shift = (event.modifiers & GLFW_MOD_SHIFT) != 0});
  if (may_open_dialog(event.key, event.modifiers)) waiting_frames_ = kDialogFrames;
}

void WindowEvents::forward(const Letter& event) {
  ImGui_ImplGlfw_CharCallback(window_, event.code);
}

void WindowEvents::forward(const Wheel& event) {
  ImGui_ImplGlfw_ScrollCallback(window_, event.right, event.up);
}

// Before 1.87 ImGui looks at the mouse when a frame begins, from then on it is told.
void WindowEvents::forward(const Place& event) {
  place_ = event;
#if IMGUI_VERSION_NUM >= 18700
  ImGui_ImplGlfw_CursorPosCallback(window_, event.x, event.y);
#endif
}

void WindowEvents::forward(const Button& event) {
  is_down_.at(event.button) = event.action != GLFW_RELEASE;
  if (event.action == GLFW_PRESS) {
    ImGui::GetIO().MouseDoubleClickTime = event.is_double ? kAnyTime : 0;
  }
#if IMGUI_VERSION_NUM >= 18700
  ImGui_ImplGlfw_MouseButtonCallback(window_, event.button, event.action, event.modifiers);
#endif
}

void WindowEvents::place_mouse() const {
#if IMGUI_VERSION_NUM < 18700
  ImGuiIO& io = ImGui::GetIO();
  io.MousePos = ImVec2(static_cast<float>(place_.x), static_cast<float>(place_.y));
  std::copy(is_down_.begin(), is_down_.end(), std::begin(io.MouseDown));
#endif
}

void WindowEvents::forward() {
#if IMGUI_VERSION_NUM >= 18700
  ImGui::GetIO().ConfigInputTrickleEventQueue = false;  // they are spread over frames here
#endif
  ImGui::GetIO().MouseDoubleClickTime = static_cast<float>(kDoubleClick);
  if (waiting_frames_ > 0) {
    --waiting_frames_;
    return;
  }
  Frame frame;
  while (!waiting_.empty() && waiting_frames_ == 0) {
    const Event event = waiting_.front();
    if (!std::visit([&](const auto& what) { return frame.fits(what); }, event)) return;
    waiting_.pop_front();
    std::visit(
        [&](const auto& what) {
          forward(what);
          frame.note(what);
        },
        event);
  }
}

bool WindowEvents::take_any() { return std::exchange(has_any_, false) || !waiting_.empty(); }

std::vector<std::string> WindowEvents::take_dropped_files() { return std::exchange(dropped_, {}); }

std::optional<double> WindowEvents::take_screen_scale() {
  return std::exchange(screen_scale_, std::nullopt);
}

std::vector<KeyPress> WindowEvents::take_keys() { return std::exchange(keys_, {}); }

}  // namespace viewer
