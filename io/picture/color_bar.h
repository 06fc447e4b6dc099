#pragma once

#include <string>
#include <vector>

#include "io/picture/color_map.h"
#include "io/picture/rgb_picture.h"

namespace io {

/// What a colour bar tells.
struct ColorBar {
  ColorScale scale;
  ColorMap map = ColorMap::viridis;
  std::vector<std::string> title;  ///< lines above it: name, unit...
  bool has_below = false;  ///< whether values below the scale are shown, as its lowest colour
  bool has_above = false;  ///< whether values above are; either is marked by an arrow
};

/// The picture with the bar beside it, at the right: as high as the picture and as wide as its
/// labels need, on white. From 128 pixels of height on all is legible; below, what does not fit is
/// cut off. Throws OutputError.
RgbPicture add_color_bar(const RgbPicture& picture, const ColorBar& bar);

/// A number as short as its six leading digits allow: "0.2", "1500", "2e-6".
std::string tick_label(double value);

}  // namespace io
