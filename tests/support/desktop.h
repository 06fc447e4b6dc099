#pragma once

#include <string>
#include <vector>

#include <sys/types.h>

namespace radiosity::test {

/// A window manager (openbox) on the display that there is, while it lives.
class WindowManager {
 public:
  /// Starts it and waits until it manages windows.
  WindowManager();
  ~WindowManager();
  WindowManager(const WindowManager&) = delete;
  WindowManager& operator=(const WindowManager&) = delete;

  /// Without openbox there is none.
  [[nodiscard]] bool is_there() const { return pid_ > 0; }

 private:
  pid_t pid_ = -1;
};

/// Where the inside of a window has its top left corner, and how large it is, pixels.
struct WindowPlace {
  int left = 0;
  int top = 0;
  int width = 0;
  int height = 0;
};

/// That of the first window whose title ends so; of no size if there is none.
WindowPlace window_place(const std::string& title_end);

/// Drops files, full paths, onto the window that takes such things, as file managers do (XDND).
/// Whether it took them.
bool drop_files(const std::vector<std::string>& paths);

}  // namespace radiosity::test
