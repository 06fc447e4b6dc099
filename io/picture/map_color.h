#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "io/picture/rgb_picture.h"

namespace io {

/// Colours for numbers. But for the last one they grow lighter evenly from low to high, so that
/// they show no steps that the numbers do not have.
enum class ColorMap {
  viridis,   ///< dark blue, green, yellow (Smith & van der Walt 2015, matplotlib; CC0)
  inferno,   ///< black, red, yellow (the same)
  cividis,   ///< blue, grey, yellow: alike for all kinds of colour vision (Nuñez et al. 2018; CC0)
  grey,      ///< black to white
  diverging  ///< blue, white, red: the middle of the scale is the lightest (Moreland 2009)
};

/// All of them, in the order of the enumeration.
std::span<const ColorMap> color_maps();
/// "viridis", "inferno", "cividis", "grey", "diverging".
std::string_view color_map_name(ColorMap map);
/// Empty if no map has that name; "gray" is understood, too.
std::optional<ColorMap> color_map_named(std::string_view name);

/// 8-bit sRGB of a position on the map, from 0 (low) to 1 (high); beyond, that of the end.
Rgb map_color(double position, ColorMap map = ColorMap::viridis);

}  // namespace io
