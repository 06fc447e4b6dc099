#pragma once

#include <Eigen/Core>
#include <string>

#include "io/picture/color_map.h"
#include "viewer/desk/look.h"

namespace viewer {

/// The range that was asked for or fits the values, logarithmic if that was asked for and any value
/// is above 0. A low end that no logarithm has becomes the least value above 0 that is shown, six
/// decades below the high end at most.
io::ColorScale shown_scale(const Look& look, const Eigen::VectorXd& values);

/// What a person must know of the scale: "logarithmic", or why it is not; "" if it is linear as
/// asked.
std::string scale_note(const Look& look, const io::ColorScale& scale);

}  // namespace viewer
