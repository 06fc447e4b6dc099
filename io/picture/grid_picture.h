#pragma once

#include <filesystem>

#include "io/picture/grid_chart.h"

namespace io {

/// Writes a chart as a .png: values blended between the points in colours, lines of equal value,
/// values at points as there is room, and a bar with the title. What is not measured is grey. Seen
/// as in `grid_svg`. Throws OutputError.
void write_grid_picture(const std::filesystem::path& path, const GridChart& chart,
                        ColorMap map = ColorMap::viridis);

}  // namespace io
