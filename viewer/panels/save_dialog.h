#pragma once

#include <string>

#include "viewer/desk/desk.h"
#include "viewer/panels/dialog_keys.h"

namespace viewer {

/// A popup that saves something under a name, and asks before it replaces a file.
class SaveDialog {
 public:
  enum class Kind { picture, result, scene, readings };

  /// Opens the popup with the next `draw`, with a name beside the file that is open.
  void open(const Desk& desk, Kind kind);
  /// Draws it, if it is open, and saves. Enter saves, Esc cancels.
  void draw(Desk& desk, const DialogKeys& keys, double scale);

 private:
  /// Whether it was saved; else the dialog tells why, or asks.
  bool save(Desk& desk);

  Kind kind_ = Kind::picture;
  bool is_due_ = false;
  std::string path_;
  std::string replaced_;  // the file that is to be replaced, once that was asked
  std::string error_;
};

}  // namespace viewer
