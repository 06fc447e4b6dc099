#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "io/picture/color_map.h"
#include "viewer/desk/look.h"

namespace viewer {

/// The range that was asked for or fits the values, logarithmic if that was asked for and any value
/// is above 0. A low end that no logarithm has becomes the least value above 0 that is shown, six
/// decades below the high end at most.
io::ColorScale shown_scale(const Look& look, const Eigen::VectorXd& values);

/// What a person must know of the scale: "logarithmic", and where that begins if a low end was
/// given that no logarithm has, or why it is not; "" if it is linear as asked.
std::string scale_note(const Look& look, const io::ColorScale& scale);

/// The labelled values of a scale: multiples of Look::tick_spacing if that is given and the scale
/// is linear, as long as there are not hundreds; else round numbers, `most` at most.
std::vector<double> legend_ticks(const Look& look, const io::ColorScale& scale, int most);

/// What it spans: "0 to 98 % of patches", of a work plane "of points", or "as given".
std::string fit_text(const Look& look);

/// The ends of a colour bar, which a hand can take.
enum class BarEnd { low, high };

/// The scale after one of its ends was dragged to the place where `position` was, which may be
/// beyond [0, 1]; round numbers, and never upside down.
io::ColorScale dragged_scale(const io::ColorScale& scale, BarEnd end, double position);

}  // namespace viewer
