#pragma once

#include <string>

#include "viewer/desk/desk.h"

namespace viewer {

/// The panel that keeps views of the scene under names.
class ViewsPanel {
 public:
  /// Needs an ImGui window.
  void draw(Desk& desk);

 private:
  std::string name_;     // of the next one
  std::string offered_;  // what that is unless it is typed
};

}  // namespace viewer
