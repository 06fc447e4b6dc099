#pragma once

#include <string>

#include "viewer/desk/desk.h"
#include "viewer/panels/file_browser.h"
#include "viewer/panels/recent_files.h"

namespace viewer {

/// The menu, the panels beside the picture and the status line. What they do is in desk.h and
/// session.h; here is only what widgets remember.
class Panels {
 public:
  explicit Panels(const study::StudyOptions& options);

  /// Draws them all and leaves the rest of a window of this size (pixels) to `desk.region`. Needs
  /// an ImGui frame; `scale` is the size of text relative to a plain screen.
  void draw(Desk& desk, int width, int height, double scale);
  /// Opens a file and remembers it.
  void open(Desk& desk, const std::string& path);
  /// Shows the popup to choose a file.
  void choose_file(const Desk& desk);
  /// Whether a popup has the keyboard.
  [[nodiscard]] static bool is_popup_open();

 private:
  enum class Save { none, screenshot, result, scene };
  void draw_menu(Desk& desk);
  void draw_popups(Desk& desk, double scale);
  void draw_solve(Desk& desk);
  void draw_watch(Desk& desk, double scale);
  void draw_status(const Desk& desk, float top, float width, float height);
  void begin_save(const Desk& desk, Save what);

  FileBrowser browser_;
  RecentFiles recent_;
  Save save_ = Save::none;
  bool is_save_due_ = false;
  std::string save_path_;
  int n_patches_;
  bool is_adaptive_;
  int method_ = 1;
  bool is_playing_ = false;
  int console_length_ = 0;
  double next_step_ = 0;  // time at which the next step is shown, s
};

/// Parts of the panels that remember nothing.
void draw_look_panel(Desk& desk);
void draw_what_if_panel(Desk& desk);
void draw_ask_panel(Desk& desk);
void draw_help(Desk& desk, double scale);

/// Does what may fail; the console tells why if it does.
template <typename Work>
void attempt(Desk& desk, const Work& work) {
  try {
    work();
  } catch (const std::exception& error) {
    desk.session.tell_error(error.what());
  }
}

}  // namespace viewer
