#include "apps/validation/plot/surface_map.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "apps/validation/plot/svg_text.h"
#include "io/base/xml_escaped.h"

namespace apps::validation {
namespace {

constexpr double kGap = 12;
constexpr double kLabel = 16;
constexpr int kPanelsAcross = 3;
constexpr double kLegendHeight = 62;
constexpr const char* kLeftOut = "#555";

using Color = std::array<double, 3>;

/// Between blue, white and red (ColorBrewer's RdBu), which are told apart without red and green.
std::string fill(double value, double limit) {
  constexpr std::array<Color, 5> kScale = {
      Color{33, 102, 172}, {146, 197, 222}, {247, 247, 247}, {244, 165, 130}, {178, 24, 43}};
  const double position = 2 + 2 * std::clamp(value / limit, -1.0, 1.0);
  const int low = std::min(static_cast<int>(position), 3);
  const double t = position - low;
  std::array<int, 3> mixed{};
  for (int c = 0; c < 3; ++c) {
    mixed[c] = static_cast<int>(std::lround((1 - t) * kScale[low][c] + t * kScale[low + 1][c]));
  }
  return fmt::format("#{:02x}{:02x}{:02x}", mixed[0], mixed[1], mixed[2]);
}

Eigen::AlignedBox2d bounds(const MapPanel& panel) {
  Eigen::AlignedBox2d box;
  for (const MapPolygon& polygon : panel.polygons) {
    for (const Eigen::Vector2d& corner : polygon.corners) box.extend(corner);
  }
  return box;
}

void draw_panel(std::string& svg, const MapPanel& panel, double limit, double scale, double left,
                double top) {
  const Eigen::AlignedBox2d box = bounds(panel);
  const auto out = std::back_inserter(svg);
  fmt::format_to(out, R"(<text x="{:.1f}" y="{:.1f}">{}</text>)", left, top + 12,
                 io::xml_escaped(panel.label));
  for (const MapPolygon& polygon : panel.polygons) {
    svg += R"(<polygon points=")";
    for (const Eigen::Vector2d& corner : polygon.corners) {
      fmt::format_to(out, "{:.1f},{:.1f} ", left + scale * (corner.x() - box.min().x()),
                     top + kLabel + scale * (box.max().y() - corner.y()));
    }
    fmt::format_to(out, R"(" fill="{}" stroke="#bbb" stroke-width="0.4"/>)",
                   polygon.value ? fill(*polygon.value, limit) : kLeftOut);
  }
}

void draw_legend(std::string& svg, const SurfaceMap& map, double top) {
  constexpr int kSteps = 40;
  constexpr double kBar = 240;
  const auto out = std::back_inserter(svg);
  for (int k = 0; k < kSteps; ++k) {
    const double value = map.limit * (2 * (k + 0.5) / kSteps - 1);
    fmt::format_to(out, R"(<rect x="{:.1f}" y="{:.1f}" width="{:.1f}" height="12" fill="{}"/>)",
                   kGap + kBar * k / kSteps, top + 20, kBar / kSteps + 0.3, fill(value, map.limit));
  }
  fmt::format_to(out, R"(<text x="{}" y="{:.1f}">{}</text>)", kGap, top + 12,
                 io::xml_escaped(map.value_label));
  for (const double share : {-1., -0.5, 0., 0.5, 1.}) {
    const char* anchor = share == -1 ? "start" : "middle";
    fmt::format_to(out, R"(<text x="{:.1f}" y="{:.1f}" text-anchor="{}">{:+.2g}</text>)",
                   kGap + kBar * (share + 1) / 2, top + 47, anchor, share * map.limit);
  }
  fmt::format_to(out, R"(<rect x="{0}" y="{1:.1f}" width="12" height="12" fill="{2}"/>)", 310,
                 top + 20, kLeftOut);
  fmt::format_to(out, R"(<text x="{}" y="{:.1f}">not compared</text>)", 328, top + 30.5);
}

}  // namespace

std::string svg(const SurfaceMap& map) {
  double widest = 0;
  for (const MapPanel& panel : map.panels) widest = std::max(widest, bounds(panel).sizes().x());
  const double column = (kSvgWidth - (kPanelsAcross + 1) * kGap) / kPanelsAcross;
  const double scale = widest > 0 ? column / widest : 1;
  std::string panels;
  double top = 0;
  double left = kGap;
  double row_height = 0;
  for (const MapPanel& panel : map.panels) {
    const Eigen::Vector2d size = scale * bounds(panel).sizes();
    const double width = std::max(size.x(), text_width(panel.label));
    if (left + width > kSvgWidth) {
      top += row_height + kGap;
      left = kGap;
      row_height = 0;
    }
    draw_panel(panels, panel, map.limit, scale, left, top);
    left += width + kGap;
    row_height = std::max(row_height, kLabel + size.y());
  }
  top += row_height + kGap;
  draw_legend(panels, map, top);
  return svg_picture(map.title, top + kLegendHeight, panels);
}

}  // namespace apps::validation
