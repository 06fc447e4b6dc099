#include "viewer/desk/shown_scale.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace viewer {
namespace {

constexpr double kLeastRatio = 1e-6;  // of the ends of a logarithmic scale
constexpr double kMostRatio = 0.1;

/// Infinite if no value is above 0.
double least_above_zero(const Eigen::VectorXd& values) {
  double least = std::numeric_limits<double>::infinity();
  for (const double value : values) {
    if (value > 0) least = std::min(least, value);
  }
  return least;
}

}  // namespace

io::ColorScale shown_scale(const Look& look, const Eigen::VectorXd& values) {
  const double least = look.logarithmic ? least_above_zero(values) : 0;
  const bool is_logarithmic =
      look.logarithmic && std::isfinite(least) && (!look.range || look.range->high > 0);
  if (!look.range) return io::fitting_scale(values, is_logarithmic);
  io::ColorScale scale = *look.range;
  scale.logarithmic = is_logarithmic;
  if (is_logarithmic && !(scale.low > 0)) {
    scale.low = std::clamp(least, kLeastRatio * scale.high, kMostRatio * scale.high);
  }
  return scale;
}

std::string scale_note(const Look& look, const io::ColorScale& scale) {
  if (scale.logarithmic) return "logarithmic";
  return look.logarithmic ? "linear: none is above 0" : "";
}

}  // namespace viewer
