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
  std::vector<double> ticks;  ///< values that are labelled, as far as there is room
  std::string fit;            ///< what the scale spans: "0 to 98 % of patches"
  double least = 0;           ///< of the values that are shown
  double greatest = 0;
  Eigen::VectorXd values;  ///< of the patches
  bool has_below = false;  ///< values below the scale are shown, as its lowest colour
  bool has_above = false;
};

}  // namespace viewer
