#include "io/light/polar_drawing.h"

#include <fmt/format.h>

#include <cmath>

#include "io/base/printable.h"
#include "io/picture/round_numbers.h"

namespace io {
namespace {

using radiosity::kPi;
using radiosity::Photometry;
using radiosity::Vec3;
using Place = Eigen::Vector2d;

constexpr double kRadius = 200;  // of the outermost circle, pixels
constexpr int kSmallText = 10;
constexpr Rgb kGridColor{204, 204, 204};
constexpr Rgb kGridText{85, 85, 85};
constexpr Rgb kTitleColor{34, 34, 34};
constexpr Rgb kFirstColor{0, 51, 102};
constexpr Rgb kSecondColor{204, 51, 51};

const Place kMiddle(240, 240);

/// Straight down is 0, to the right 90 degrees.
Place at(double radius, double angle) {
  return kMiddle + radius * Place(std::sin(angle), std::cos(angle));
}

void add_polar_grid(double outermost, double step, PolarDrawing& drawing) {
  constexpr int kSides = 180;
  for (const double value : multiples_within(step, outermost, step)) {
    const double radius = kRadius * value / outermost;
    PolarDrawing::Line circle{{}, kGridColor};
    for (int k = 0; k <= kSides; ++k) circle.points.push_back(at(radius, 2 * kPi * k / kSides));
    drawing.lines.push_back(circle);
    drawing.labels.push_back(
        {kMiddle + Place(2, radius - 2), fmt::format("{:g}", value), kSmallText, kGridText});
  }
  for (int degrees = 0; degrees < 360; degrees += 30) {
    const double angle = degrees * kPi / 180;
    drawing.lines.push_back({{kMiddle, at(kRadius, angle)}, kGridColor});
    drawing.labels.push_back({at(kRadius + 14, angle) + Place(0, 4),
                              fmt::format("{}", degrees <= 180 ? degrees : 360 - degrees),
                              kSmallText, kGridText, 0.5});
  }
}

/// The curve in the plane C (right) and C + π (left).
PolarDrawing::Line curve_in(const Photometry& photometry, double plane, double outermost) {
  constexpr int kSteps = 720;  // half degrees
  PolarDrawing::Line line;
  line.width = 2;
  for (int k = 0; k <= kSteps; ++k) {
    const double angle = -kPi + 2 * kPi * k / kSteps;
    const Vec3 direction(std::sin(angle) * std::cos(plane), std::sin(angle) * std::sin(plane),
                         -std::cos(angle));
    line.points.push_back(at(kRadius * intensity(photometry.web, direction) / outermost, angle));
  }
  return line;
}

}  // namespace

PolarDrawing polar_drawing(const Photometry& photometry) {
  constexpr double kCircles = 5;
  constexpr double kRounding = 1e-9;
  const double peak = peak_intensity(photometry.web).intensity;
  const double step = round_up(peak / kCircles);
  const double outermost = step * std::ceil(peak / step - kRounding);
  const bool is_rotational = symmetry_of(photometry.web).is_rotational;
  PolarDrawing drawing;
  drawing.title =
      printable(photometry.name.empty() ? photometry.file.filename().string() : photometry.name);
  drawing.labels.push_back({Place(10, 16), drawing.title + ", cd", 12, kTitleColor});
  add_polar_grid(outermost, step, drawing);
  const Place left(10, drawing.size - 6);
  if (is_rotational) {
    drawing.labels.push_back({left, "all planes", 12, kFirstColor});
  } else {
    PolarDrawing::Line second = curve_in(photometry, kPi / 2, outermost);
    second.color = kSecondColor;
    second.is_dashed = true;
    drawing.lines.push_back(second);
    drawing.labels.push_back({left, "C0 (right) - C180", 12, kFirstColor});
    drawing.labels.push_back(
        {Place(drawing.size - 10, left.y()), "C90 (right) - C270", 12, kSecondColor, 1});
  }
  PolarDrawing::Line first = curve_in(photometry, 0, outermost);
  first.color = kFirstColor;
  drawing.lines.push_back(first);
  return drawing;
}

}  // namespace io
