#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "io/picture/color_map.h"

namespace viewer {

/// What the colour bar beside the picture tells.
struct Legend {
  std::vector<std::string> title;
  std::string unit;  ///< "" of plain numbers
  io::ColorScale scale;
  io::ColorMap map = io::ColorMap::viridis;
  double least = 0;  ///< of the values that are shown
  double greatest = 0;
  Eigen::VectorXd values;  ///< of the patches
  bool has_below = false;  ///< values below the scale are shown, as its lowest colour
  bool has_above = false;
};

}  // namespace viewer
