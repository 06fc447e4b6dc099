#include "apps/validation/reference/statistics.h"

#include <algorithm>
#include <cmath>

#include "radiosity/base/geometry.h"

namespace apps::validation {

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
}

double fitted_order(const std::vector<double>& x, const std::vector<double>& y) {
  const auto n = static_cast<double>(x.size());
  double sx = 0;
  double sy = 0;
  double sxx = 0;
  double sxy = 0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    const double u = std::log(x[k]);
    const double v = std::log(y[k]);
    sx += u;
    sy += v;
    sxx += u * u;
    sxy += u * v;
  }
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

Plot normal_histogram(const std::string& title, const std::string& label,
                      const std::vector<double>& values) {
  constexpr double kEnd = 5;
  constexpr int kBins = 40;
  constexpr double kWidth = 2 * kEnd / kBins;
  Series counts{"found", Series::Style::bars};
  Series normal{"normal distribution", Series::Style::line};
  counts.y.assign(kBins, 0);
  for (int k = 0; k < kBins; ++k) {
    const double center = -kEnd + (k + 0.5) * kWidth;
    counts.x.push_back(center);
    normal.x.push_back(center);
    normal.y.push_back(kWidth * std::exp(-0.5 * center * center) / std::sqrt(2 * radiosity::kPi));
  }
  for (const double value : values) {
    const double bin = std::floor((std::clamp(value, -kEnd, kEnd) + kEnd) / kWidth);
    counts.y[std::min(static_cast<int>(bin), kBins - 1)] += 1 / static_cast<double>(values.size());
  }
  return {title, {label}, {"share"}, {counts, normal}};
}

}  // namespace apps::validation
