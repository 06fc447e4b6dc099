#pragma once

#include <memory>

#include "io/picture/rgb_picture.h"
#include "viewer/desk/region.h"
#include "viewer/draw/texture.h"

namespace viewer {

/// A picture over the scene and below panels and outlines.
class Backdrop {
 public:
  /// Draws it into ImGui's background; nothing if it is null.
  void draw(const std::shared_ptr<const io::RgbPicture>& picture, const Region& region);

 private:
  Texture texture_{Texture::Scaling::nearest};
};

}  // namespace viewer
