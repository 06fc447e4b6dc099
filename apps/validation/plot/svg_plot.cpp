#include "apps/validation/plot/svg_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <optional>

#include "apps/validation/plot/axis_ticks.h"
#include "apps/validation/plot/svg_text.h"
#include "io/base/xml_escaped.h"

namespace apps::validation {
namespace {

constexpr double kPlotHeight = 250;  // of the framed area
constexpr double kLeft = 66;
constexpr double kRight = 16;
constexpr double kBottom = 46;
constexpr double kTop = 8;
constexpr double kLegendRow = 18;
constexpr double kMarker = 3.2;

// Okabe and Ito's colours, which everybody can tell apart.
constexpr std::array<const char*, 6> kColors = {"#0072b2", "#d55e00", "#009e73",
                                                "#a0519f", "#b07d00", "#3f9bd1"};

struct Canvas {
  std::string svg;

  template <typename... Args>
  void add(fmt::format_string<Args...> format, Args&&... args) {
    fmt::format_to(std::back_inserter(svg), format, std::forward<Args>(args)...);
  }
};

bool has_markers(Series::Style style) {
  return style == Series::Style::markers || style == Series::Style::line_and_markers;
}

bool has_line(Series::Style style) {
  return style != Series::Style::markers && style != Series::Style::bars;
}

const char* color(std::size_t series) { return kColors[series % kColors.size()]; }

void add_marker(Canvas& canvas, std::size_t series, double x, double y) {
  const double r = kMarker;
  switch (series % 4) {
    case 0:
      canvas.add(R"(<circle cx="{:.1f}" cy="{:.1f}" r="{}" fill="{}"/>)", x, y, r, color(series));
      break;
    case 1:
      canvas.add(R"(<rect x="{:.1f}" y="{:.1f}" width="{}" height="{}" fill="{}"/>)", x - 0.9 * r,
                 y - 0.9 * r, 1.8 * r, 1.8 * r, color(series));
      break;
    case 2:
      canvas.add(R"(<path d="M{:.1f} {:.1f}l{} {}h{}z" fill="{}"/>)", x, y - 1.2 * r, 1.2 * r,
                 2.1 * r, -2.4 * r, color(series));
      break;
    default:
      canvas.add(R"(<path d="M{:.1f} {:.1f}l{} {}l{} {}l{} {}z" fill="{}"/>)", x, y - 1.3 * r,
                 1.3 * r, 1.3 * r, -1.3 * r, 1.3 * r, -1.3 * r, -1.3 * r, color(series));
  }
}

std::string stroke(std::size_t series, Series::Style style) {
  return fmt::format(R"(fill="none" stroke="{}" stroke-width="1.6"{})", color(series),
                     style == Series::Style::dashed ? R"( stroke-dasharray="6 4")" : "");
}

/// Where the legend's entries stand, wrapped into rows.
struct Legend {
  struct Entry {
    std::size_t series;
    double x;
    int row;
  };
  std::vector<Entry> entries;
  int n_rows = 0;
};

Legend layout_legend(const std::vector<Series>& series) {
  Legend legend;
  double x = kLeft;
  for (std::size_t s = 0; s < series.size(); ++s) {
    if (series[s].label.empty()) continue;
    const double width = 28 + text_width(series[s].label) + 14;
    if (legend.n_rows == 0 || x + width > kSvgWidth) {
      ++legend.n_rows;
      x = kLeft;
    }
    legend.entries.push_back({s, x, legend.n_rows - 1});
    x += width;
  }
  return legend;
}

void draw_legend(Canvas& canvas, const Legend& legend, const std::vector<Series>& series) {
  for (const auto& [s, x, row] : legend.entries) {
    const double y = kTop + kLegendRow * (row + 0.5);
    const Series::Style style = series[s].style;
    if (style == Series::Style::bars) {
      canvas.add(R"(<rect x="{}" y="{}" width="22" height="9" fill="{}" fill-opacity="0.55"/>)", x,
                 y - 4.5, color(s));
    }
    if (has_line(style)) {
      canvas.add(R"(<path d="M{:.1f} {:.1f}h22" {}/>)", x, y, stroke(s, style));
    }
    if (has_markers(style)) add_marker(canvas, s, x + 11, y);
    canvas.add(R"(<text x="{:.1f}" y="{:.1f}">{}</text>)", x + 28, y + 4,
               io::xml_escaped(series[s].label));
  }
}

/// From data to the picture.
struct Frame {
  AxisRange x;
  AxisRange y;
  double top = 0;

  [[nodiscard]] double left_of(double value) const {
    return kLeft + (kSvgWidth - kLeft - kRight) * x.position(value);
  }
  [[nodiscard]] double top_of(double value) const {
    return top + kPlotHeight * (1 - y.position(value));
  }
};

Frame make_frame(const Plot& plot, double top) {
  std::vector<double> x;
  std::vector<double> y;
  for (const Series& series : plot.series) {
    const bool is_bars = series.style == Series::Style::bars;
    if (is_bars) y.push_back(0);
    for (std::size_t k = 0; k < std::min(series.x.size(), series.y.size()); ++k) {
      x.push_back(series.x[k]);
      y.push_back(series.y[k]);
    }
  }
  return {make_range(plot.x.scale, x), make_range(plot.y.scale, y), top};
}

void draw_axes(Canvas& canvas, const Frame& frame, const Plot& plot) {
  const double bottom = frame.top + kPlotHeight;
  const double right = kSvgWidth - kRight;
  for (const double tick : frame.x.ticks) {
    const double x = frame.left_of(tick);
    canvas.add(R"(<path d="M{0:.1f} {1:.1f}V{2:.1f}" stroke="#e2e2e2"/>)", x, frame.top, bottom);
    canvas.add(R"(<text x="{:.1f}" y="{:.1f}" text-anchor="middle">{}</text>)", x, bottom + 17,
               tick_text(tick, plot.x.scale));
  }
  for (const double tick : frame.y.ticks) {
    const double y = frame.top_of(tick);
    canvas.add(R"(<path d="M{:.1f} {:.1f}H{:.1f}" stroke="#e2e2e2"/>)", kLeft, y, right);
    canvas.add(R"(<text x="{:.1f}" y="{:.1f}" text-anchor="end">{}</text>)", kLeft - 6, y + 4,
               tick_text(tick, plot.y.scale));
  }
  canvas.add(R"(<rect x="{}" y="{}" width="{}" height="{}" fill="none" stroke="#777"/>)", kLeft,
             frame.top, right - kLeft, kPlotHeight);
  canvas.add(R"(<text x="{:.1f}" y="{:.1f}" text-anchor="middle">{}</text>)", (kLeft + right) / 2,
             bottom + 38, io::xml_escaped(plot.x.label));
  canvas.add(
      R"svg(<text transform="translate(14 {:.1f}) rotate(-90)" text-anchor="middle">{}</text>)svg",
      frame.top + kPlotHeight / 2, io::xml_escaped(plot.y.label));
}

void draw_bars(Canvas& canvas, const Frame& frame, const Series& series, std::size_t s) {
  if (series.x.size() < 2) return;
  const double half = 0.47 * (series.x[1] - series.x[0]);
  for (std::size_t k = 0; k < series.x.size(); ++k) {
    const double left = std::max(frame.left_of(series.x[k] - half), kLeft);
    const double right = std::min(frame.left_of(series.x[k] + half), kSvgWidth - kRight);
    canvas.add(R"(<rect x="{:.1f}" y="{:.1f}" width="{:.1f}" height="{:.1f}" fill="{}" )"
               R"(fill-opacity="0.55"/>)",
               left, frame.top_of(series.y[k]), right - left,
               frame.top_of(0) - frame.top_of(series.y[k]), color(s));
  }
}

void draw_series(Canvas& canvas, const Frame& frame, const Series& series, std::size_t s) {
  if (series.style == Series::Style::bars) {
    draw_bars(canvas, frame, series, s);
    return;
  }
  std::string path;
  bool is_down = false;  // the pen, after a first point
  for (std::size_t k = 0; k < std::min(series.x.size(), series.y.size()); ++k) {
    const bool is_shown = frame.x.shows(series.x[k]) && frame.y.shows(series.y[k]);
    if (is_shown) {
      const double x = frame.left_of(series.x[k]);
      const double y = frame.top_of(series.y[k]);
      path += fmt::format("{}{:.1f} {:.1f}", is_down ? 'L' : 'M', x, y);
      if (has_markers(series.style)) add_marker(canvas, s, x, y);
    }
    is_down = is_shown;
  }
  if (has_line(series.style)) {
    canvas.add(R"(<path d="{}" {}/>)", path, stroke(s, series.style));
  }
}

}  // namespace

std::string svg(const Plot& plot) {
  const Legend legend = layout_legend(plot.series);
  const double top = kTop + kLegendRow * legend.n_rows + (legend.n_rows > 0 ? 4 : 0);
  const Frame frame = make_frame(plot, top);
  Canvas canvas;
  draw_axes(canvas, frame, plot);
  for (std::size_t s = 0; s < plot.series.size(); ++s) {
    draw_series(canvas, frame, plot.series[s], s);
  }
  draw_legend(canvas, legend, plot.series);
  return svg_picture(plot.title, top + kPlotHeight + kBottom, canvas.svg);
}

}  // namespace apps::validation
