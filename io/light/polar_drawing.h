#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "io/picture/rgb_picture.h"
#include "radiosity/scene/photometry.h"

namespace io {

/// A luminaire's polar curve as lines and texts, whichever way they are drawn. Places are in pixels
/// from the top left.
struct PolarDrawing {
  struct Line {
    std::vector<Eigen::Vector2d> points;
    Rgb color{};
    double width = 1;
    bool is_dashed = false;
  };
  struct Label {
    Eigen::Vector2d place;  ///< on the text's base line
    std::string text;
    int size = 12;
    Rgb color{};
    double anchor = 0;  ///< which share of the text's width is left of the place
  };
  int size = 480;  ///< pixels a side
  std::string title;
  std::vector<Line> lines;
  std::vector<Label> labels;
};

/// Intensity in cd over the angle to the axis, in the planes C0-C180 and, dashed, C90-C270 unless
/// it is rotational.
PolarDrawing polar_drawing(const radiosity::Photometry& photometry);

}  // namespace io
