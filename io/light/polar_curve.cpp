#include "io/light/polar_curve.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>

#include "io/base/atomic_file.h"
#include "io/base/printable.h"
#include "io/picture/round_numbers.h"

namespace io {
namespace {

using radiosity::kPi;
using radiosity::Photometry;
using radiosity::Vec3;

constexpr double kSize = 480;    // pixels
constexpr double kRadius = 200;  // of the outermost circle
constexpr double kTop = 40;      // above it

double center() { return kSize / 2; }
double middle() { return kTop + kRadius; }

std::string escaped_text(const std::string& text) {
  std::string result;
  for (const char c : printable(text)) {
    result += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : std::string(1, c);
  }
  return result;
}

/// Circles of intensities and rays of angles.
std::string polar_grid(double outermost, double step) {
  std::string svg = "<g fill=\"none\" stroke=\"#ccc\">";
  std::string labels = "<g fill=\"#555\" font-size=\"10\">";
  for (const double value : multiples_within(step, outermost, step)) {
    const double radius = kRadius * value / outermost;
    svg += fmt::format("<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"{:.2f}\"/>", center(), middle(),
                       radius);
    labels += fmt::format("<text x=\"{:.2f}\" y=\"{:.2f}\">{:g}</text>", center() + 2,
                          middle() + radius - 2, value);
  }
  for (int degrees = 0; degrees < 360; degrees += 30) {
    const double angle = degrees * kPi / 180;
    const double x = center() + kRadius * std::sin(angle);
    const double y = middle() + kRadius * std::cos(angle);
    svg += fmt::format("<path d=\"M{:.2f},{:.2f}L{:.2f},{:.2f}\"/>", center(), middle(), x, y);
    labels += fmt::format("<text x=\"{:.2f}\" y=\"{:.2f}\" text-anchor=\"middle\">{}°</text>",
                          center() + (kRadius + 14) * std::sin(angle),
                          middle() + (kRadius + 14) * std::cos(angle) + 4,
                          degrees <= 180 ? degrees : 360 - degrees);
  }
  return svg + "</g>" + labels + "</g>";
}

/// The curve in the plane C (right) and C + π (left).
std::string curve(const Photometry& photometry, double plane, double outermost,
                  const std::string& style) {
  constexpr int kSteps = 720;  // half degrees
  std::string path;
  for (int k = 0; k <= kSteps; ++k) {
    const double angle = -kPi + 2 * kPi * k / kSteps;
    const Vec3 direction(std::sin(angle) * std::cos(plane), std::sin(angle) * std::sin(plane),
                         -std::cos(angle));
    const double radius = kRadius * intensity(photometry.web, direction) / outermost;
    path += fmt::format("{}{:.2f},{:.2f}", k == 0 ? "M" : "L", center() + radius * std::sin(angle),
                        middle() + radius * std::cos(angle));
  }
  return fmt::format("<path d=\"{}\" fill=\"none\" stroke-width=\"2\" {}/>", path, style);
}

std::string polar_svg(const Photometry& photometry) {
  constexpr double kCircles = 5;
  const double step = round_up(peak_intensity(photometry.web).intensity / kCircles);
  const double outermost = step * std::ceil(peak_intensity(photometry.web).intensity / step - 1e-9);
  const bool is_rotational = symmetry_of(photometry.web).is_rotational;
  const std::string name =
      photometry.name.empty() ? photometry.file.filename().string() : photometry.name;
  std::string svg = fmt::format(
      R"(<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {0:g} {0:g}" width="{0:g}" )"
      R"(height="{0:g}" role="img" font-family="Helvetica,Arial,sans-serif" font-size="12" )"
      R"(fill="#222"><rect width="{0:g}" height="{0:g}" fill="#fff"/><title>{1}</title>)"
      R"(<text x="10" y="18">{1}, cd</text>)",
      kSize, escaped_text(name));
  svg += polar_grid(outermost, step);
  if (!is_rotational) {
    svg += curve(photometry, kPi / 2, outermost, "stroke=\"#c33\" stroke-dasharray=\"6 4\"");
  }
  svg += curve(photometry, 0, outermost, "stroke=\"#036\"");
  svg += fmt::format("<text x=\"10\" y=\"{:g}\" fill=\"#036\">{}</text>", kSize - 8,
                     is_rotational ? "all planes" : "C0 (right) - C180");
  if (!is_rotational) {
    svg += fmt::format(
        "<text x=\"{:g}\" y=\"{:g}\" fill=\"#c33\" text-anchor=\"end\">C90 (right) - C270</text>",
        kSize - 10, kSize - 8);
  }
  return svg + "</svg>\n";
}

}  // namespace

void write_polar_curve(const std::filesystem::path& path, const Photometry& photometry) {
  const std::string svg = polar_svg(photometry);
  write_stream_atomically(path, [&](std::ofstream& stream) { stream << svg; });
}

}  // namespace io
