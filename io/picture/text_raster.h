#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace io {

/// A line of text as pixels: how much of each the letters cover, row by row from the top left.
struct TextRaster {
  int width = 0;
  int height = 0;  ///< the same for all texts of a size, so that they stand on one line
  std::vector<std::uint8_t> coverage;
};

/// Letters in VTK's own sans-serif font (ASCII and ²), `size` pixels high in the sense of fonts
/// (capitals have 0.7 of it). Needs no window and no graphics card. Not for two threads at once.
/// Throws OutputError if VTK cannot draw it.
TextRaster rasterize(const std::string& text, int size);

}  // namespace io
