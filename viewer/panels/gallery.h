#pragma once

#include <deque>

#include "viewer/desk/desk.h"
#include "viewer/draw/texture.h"

namespace viewer {

/// The scenes that come with the program, where the picture would be, while nothing is open.
class Gallery {
 public:
  /// Draws them over the desk's region. Needs an ImGui frame; `scale` is the size of text relative
  /// to a plain screen.
  void draw(Desk& desk, double scale);

 private:
  /// Whether it was clicked.
  bool draw_card(const Example& example, std::size_t k, double scale);

  std::deque<Texture> textures_;  // one for each
};

}  // namespace viewer
