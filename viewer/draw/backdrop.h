#pragma once

#include <memory>

#include "io/picture/rgb_picture.h"
#include "viewer/desk/region.h"

namespace viewer {

/// A picture over the scene and below panels and outlines, as a texture of the window's OpenGL
/// context, which must be there as long.
class Backdrop {
 public:
  Backdrop() = default;
  ~Backdrop();
  Backdrop(const Backdrop&) = delete;
  Backdrop& operator=(const Backdrop&) = delete;

  /// Draws it into ImGui's background; nothing if it is null.
  void draw(const std::shared_ptr<const io::RgbPicture>& picture, const Region& region);

 private:
  std::shared_ptr<const io::RgbPicture> picture_;  // that the texture holds
  unsigned texture_ = 0;
};

}  // namespace viewer
