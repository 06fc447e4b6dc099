#pragma once

#include <imgui.h>

#include <memory>

#include "io/picture/rgb_picture.h"

namespace viewer {

/// A picture as ImGui draws it, in the window's OpenGL context, which must be there as long.
class Texture {
 public:
  /// How it is drawn in another size.
  enum class Scaling { nearest, smooth };
  explicit Texture(Scaling scaling = Scaling::smooth) : scaling_(scaling) {}
  ~Texture();
  Texture(const Texture&) = delete;
  Texture& operator=(const Texture&) = delete;

  /// Uploads the picture unless it is the one that is there.
  ImTextureID of(const std::shared_ptr<const io::RgbPicture>& picture);
  /// Forgets which picture that is.
  void forget() { picture_.reset(); }

 private:
  Scaling scaling_;
  std::shared_ptr<const io::RgbPicture> picture_;
  unsigned name_ = 0;
};

}  // namespace viewer
