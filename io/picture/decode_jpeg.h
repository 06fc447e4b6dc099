#pragma once

#include <cstddef>
#include <string_view>

#include "io/picture/rgb_picture.h"

namespace io {

/// The same as decode_picture of a JPEG file. Without libjpeg it throws SceneError.
RgbPicture decode_jpeg(std::string_view file, std::size_t most_pixels);

/// Throws SceneError if a picture has more than `most_pixels`.
void check_picture_size(std::size_t width, std::size_t height, std::size_t most_pixels);

}  // namespace io
