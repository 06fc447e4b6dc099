#pragma once

#include <functional>
#include <span>
#include <string>

#include "viewer/desk/desk.h"
#include "viewer/desk/key_press.h"
#include "viewer/panels/attempt.h"
#include "viewer/panels/console_panel.h"
#include "viewer/panels/daylight_panel.h"
#include "viewer/panels/file_browser.h"
#include "viewer/panels/gallery.h"
#include "viewer/panels/lamp_maker.h"
#include "viewer/panels/measure_panel.h"
#include "viewer/panels/recent_files.h"
#include "viewer/panels/save_dialog.h"
#include "viewer/panels/surfaces_panel.h"
#include "viewer/panels/tour_box.h"
#include "viewer/panels/views_panel.h"
#include "viewer/panels/watch_panel.h"

namespace viewer {

/// The menu, the panels beside the picture and the status line. What they do is in desk.h and
/// session.h; here is only what widgets remember.
class Panels {
 public:
  explicit Panels(const study::StudyOptions& options);

  /// Draws them all and leaves the rest of a window of this size (pixels) to `desk.region`. `keys`
  /// are those that were pressed since the last call. Needs an ImGui frame; `scale` is the size of
  /// text relative to a plain screen.
  void draw(Desk& desk, std::span<const KeyPress> keys, int width, int height, double scale);
  /// Notes a file that was opened, to offer it again.
  void remember(const std::string& path) { recent_.add(path); }
  /// Shows the popup to choose a file.
  void choose_file(const Desk& desk) { browser_.open(desk.session.model().path); }
  /// Shows the popup to save something.
  void begin_save(const Desk& desk, SaveDialog::Kind kind) { save_.open(desk, kind); }
  /// Whether a popup has the keyboard.
  [[nodiscard]] static bool is_popup_open();

 private:
  void draw_menu(Desk& desk);
  void draw_file_menu(Desk& desk);
  /// Draws a part of a panel that the tour may point at.
  template <typename Draw>
  void draw_part(const Desk& desk, TourTarget target, const Draw& draw);
  void draw_ask(Desk& desk);
  void draw_solve(Desk& desk);
  void draw_status(Desk& desk, float top, float width, float height);

  FileBrowser browser_;
  RecentFiles recent_;
  SaveDialog save_;
  ViewsPanel views_;
  MeasurePanel measure_;
  DaylightPanel daylight_;
  LampMaker lamp_maker_;
  SurfacesPanel surfaces_;
  WatchPanel watch_;
  ConsolePanel console_;
  Gallery gallery_;
  TourBox tour_;
  int n_patches_;
  bool is_adaptive_;
  bool is_narrow_ = false;  // the window has no room for panels beside the picture
  bool is_called_ = false;  // they are wanted all the same
};

/// Parts of the panels that remember nothing.
void draw_scene_panel(Desk& desk);
void draw_look_panel(Desk& desk);
void draw_compare_panel(Desk& desk);
void draw_what_if_panel(Desk& desk);
/// `draw_deeds` draws what can be done with a patch that is asked, where it does not move.
void draw_ask_panel(Desk& desk, const std::function<void()>& draw_deeds);
void draw_heat_panel(const Desk& desk);
void draw_help(Desk& desk, double scale);

}  // namespace viewer
