#include "viewer/draw/window_events.h"

#include <GLFW/glfw3.h>
#include <imgui.h>
#include <imgui_impl_glfw.h>

#include <algorithm>
#include <set>
#include <utility>

namespace viewer {
namespace {

/// The key that bears the letter, as the user's keyboard has it.
int lettered_key(int key, int scancode) {
  const char* name = glfwGetKeyName(key, scancode);
  const bool is_letter = name != nullptr && name[0] >= 'a' && name[0] <= 'z' && name[1] == '\0';
  return is_letter ? GLFW_KEY_A + (name[0] - 'a') : key;
}

/// Frames after which a dialog that a key has opened or closed takes letters.
constexpr int kDialogFrames = 3;

bool may_open_dialog(int key, int modifiers) {
  return (modifiers & GLFW_MOD_CONTROL) != 0 || key == GLFW_KEY_ENTER || key == GLFW_KEY_KP_ENTER ||
         key == GLFW_KEY_ESCAPE;
}

/// From 1.87 on ImGui spreads events over frames by itself, which a fast click needs: down in one,
/// up in the next. Keys are in order here, and must not lag behind those that the viewer takes at
/// once: they wait for that.
#if IMGUI_VERSION_NUM >= 18700
constexpr int kClickFrames = 2;
void set_trickling(bool is_on) { ImGui::GetIO().ConfigInputTrickleEventQueue = is_on; }
#else
constexpr int kClickFrames = 0;
void set_trickling(bool /*is_on*/) {}
#endif

}  // namespace

WindowEvents& WindowEvents::of(GLFWwindow* window) {
  return *static_cast<WindowEvents*>(glfwGetWindowUserPointer(window));
}

WindowEvents::WindowEvents(GLFWwindow* window) : window_(window) {
  glfwSetWindowUserPointer(window, this);
  glfwSetDropCallback(window, [](GLFWwindow* source, int n, const char** paths) {
    of(source).dropped_.insert(of(source).dropped_.end(), paths, paths + n);
    of(source).has_any_ = true;
  });
  glfwSetMouseButtonCallback(window, [](GLFWwindow* source, int, int, int) {
    of(source).has_any_ = true;
    of(source).waiting_frames_ = std::max(of(source).waiting_frames_, kClickFrames);
  });
  const auto note_place = [](GLFWwindow* source, double, double) { of(source).has_any_ = true; };
  glfwSetCursorPosCallback(window, note_place);
  glfwSetScrollCallback(window, note_place);
  glfwSetCursorEnterCallback(window, [](GLFWwindow* source, int) { of(source).has_any_ = true; });
  const auto note_window = [](GLFWwindow* source) { of(source).has_any_ = true; };
  glfwSetWindowRefreshCallback(window, note_window);
  glfwSetWindowCloseCallback(window, note_window);
  glfwSetFramebufferSizeCallback(window,
                                 [](GLFWwindow* source, int, int) { of(source).has_any_ = true; });
}

void WindowEvents::hold_keys() {
  glfwSetKeyCallback(window_, [](GLFWwindow* source, int key, int scancode, int action, int mods) {
    of(source).waiting_.push_back({key, scancode, action, mods});
  });
  glfwSetCharCallback(window_, [](GLFWwindow* source, unsigned letter) {
    of(source).waiting_.push_back({.letter = letter});
  });
}

void WindowEvents::forward(const KeyEvent& event) {
  if (event.letter != 0) {
    ImGui_ImplGlfw_CharCallback(window_, event.letter);
    return;
  }
  ImGui_ImplGlfw_KeyCallback(window_, event.key, event.scancode, event.action, event.modifiers);
  if (event.action == GLFW_RELEASE) return;
  keys_.push_back({.key = lettered_key(event.key, event.scancode),
                   .has_control = (event.modifiers & GLFW_MOD_CONTROL) != 0,
                   .has_shift = (event.modifiers & GLFW_MOD_SHIFT) != 0});
}

void WindowEvents::forward_keys() {
  set_trickling(true);
  if (waiting_frames_ > 0) {
    --waiting_frames_;
    return;
  }
  std::set<int> pressed;
  while (!waiting_.empty()) {
    const KeyEvent event = waiting_.front();
    // ImGui looks once a frame at keys that give no letter: it would not see one that is up again.
    const bool is_over = event.letter == 0 && event.action == GLFW_RELEASE;
    if (is_over && pressed.contains(event.key)) return;
    waiting_.pop_front();
    forward(event);
    set_trickling(false);
    if (event.letter != 0 || is_over) continue;
    if (event.key >= GLFW_KEY_ESCAPE) pressed.insert(event.key);  // below are those with letters
    if (may_open_dialog(event.key, event.modifiers)) {
      waiting_frames_ = kDialogFrames;
      return;
    }
  }
}

bool WindowEvents::take_any() { return std::exchange(has_any_, false) || !waiting_.empty(); }

std::vector<std::string> WindowEvents::take_dropped_files() { return std::exchange(dropped_, {}); }

std::vector<KeyPress> WindowEvents::take_keys() { return std::exchange(keys_, {}); }

}  // namespace viewer
