#pragma once

#include <cstddef>
#include <string_view>

#include "io/picture/rgb_picture.h"

namespace io {

/// Pixels of a .png or, where the program is built with libjpeg, a .jpg, told apart by their first
/// bytes: 8-bit sRGB without what they have of transparency. Throws SceneError, which says why but
/// not of which file, for what is damaged, of another kind, or has more than `most_pixels`.
RgbPicture decode_picture(std::string_view file, std::size_t most_pixels);

}  // namespace io
