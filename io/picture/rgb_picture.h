#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace io {

/// 8-bit sRGB, three bytes a pixel, row by row from the top left.
struct RgbPicture {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> bytes;
};

using Rgb = std::array<std::uint8_t, 3>;

}  // namespace io
