#pragma once

#include <imgui.h>

#include <filesystem>
#include <map>

#include "viewer/desk/desk.h"
#include "viewer/desk/tour.h"

namespace viewer {

/// The tour's box beside what it points at.
class TourBox {
 public:
  /// Notes where something is drawn in this frame, in pixels of the window.
  void place(TourTarget target, ImVec2 low, ImVec2 high) { places_[target] = {low, high}; }
  /// Scrolls an ImGui window to where it draws, once, when the tour comes there.
  void scroll_to(const Desk& desk, TourTarget target);
  /// Draws the box and a frame around its target. Needs an ImGui frame; `scale` is the size of text
  /// relative to a plain screen.
  void draw(Desk& desk, double scale);

 private:
  struct Place {
    ImVec2 low;
    ImVec2 high;
  };
  std::map<TourTarget, Place> places_;  // of this frame
  int scrolled_ = -1;                   // step that was scrolled to
};

/// Whether this is the first time, by a file that does not exist then, and does afterwards. False
/// if none can be kept.
bool is_first_visit(const std::filesystem::path& file);

}  // namespace viewer
