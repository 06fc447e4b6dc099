#include "io/picture/grid_chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <string_view>
#include <utility>

#include "io/base/xml_escaped.h"

namespace io {
namespace {

using radiosity::Index;
using radiosity::PointPlace;
using Point = Eigen::Vector2d;

constexpr double kPlotSide = 560;  // of the larger side, pixels
constexpr double kMargin = 34;
constexpr double kBarWidth = 16;
constexpr double kBarRoom = 96;
constexpr double kFont = 11;
constexpr double kAdvance = 0.58;  // of a digit, relative to the font
constexpr int kMostLevels = 9;
constexpr const char* kMasked = "#bbb";

bool is_open(const GridChart& chart, Index k) {
  return chart.places[static_cast<std::size_t>(k)] == PointPlace::open;
}

std::string color_text(double position, ColorMap map) {
  const Rgb color = map_color(position, map);
  return fmt::format("#{:02x}{:02x}{:02x}", color[0], color[1], color[2]);
}

/// Ink that can be read upon a colour of the map.
const char* ink(double position, ColorMap map) {
  const Rgb color = map_color(position, map);
  return 0.3 * color[0] + 0.6 * color[1] + 0.1 * color[2] > 120 ? "#111" : "#fff";
}

/// A text about a middle, pixels.
struct Label {
  Point middle;
  double half_width;

  [[nodiscard]] bool meets(const Label& other) const {
    return std::abs(middle.x() - other.middle.x()) < half_width + other.half_width + 2 &&
           std::abs(middle.y() - other.middle.y()) < kFont + 1;
  }
};

class Drawing {
 public:
  Drawing(const GridChart& chart, ColorMap map)
      : chart_(chart), map_(map), scale_(chart_scale(chart)) {
    const double width = static_cast<double>(chart.grid.n_columns) * chart.grid.column.norm();
    const double height = static_cast<double>(chart.grid.n_rows) * chart.grid.row.norm();
    per_metre_ = kPlotSide / std::max(width, height);
    width_ = per_metre_ * width;
    height_ = std::max(per_metre_ * height, 1.0);
    cell_ = {width_ / static_cast<double>(chart.grid.n_columns),
             height_ / static_cast<double>(chart.grid.n_rows)};
  }

  std::string svg() {
    const double total_width =
        std::max(width_ + kMargin + kBarRoom,
                 2 * kMargin + kAdvance * 1.2 * kFont * static_cast<double>(chart_.title.size()));
    const double total_height = std::max(height_, 120.0) + 2.3 * kMargin;
    add("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.0f} {1:.0f}\" "
        "width=\"{0:.0f}\" height=\"{1:.0f}\" font-family=\"Helvetica,Arial,sans-serif\" "
        "font-size=\"{2}\" fill=\"#222\"><title>{3}</title>\n"
        "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n"
        "<text x=\"{4}\" y=\"18\" font-size=\"13\" font-weight=\"bold\">{3}</text>\n",
        total_width, total_height, kFont, xml_escaped(chart_.title), kMargin);
    add_cells();
    const std::string below = std::exchange(svg_, "");
    add_marks();  // before the lines' numbers, so that there is room for them
    const std::string marks = std::exchange(svg_, "");
    add_lines();
    svg_ = below + svg_ + marks;
    add_values();
    add_frame();
    add_bar();
    return svg_ + "</svg>\n";
  }

 private:
  template <typename... Args>
  void add(fmt::format_string<Args...> format, Args&&... args) {
    fmt::format_to(std::back_inserter(svg_), format, std::forward<Args>(args)...);
  }

  /// Of columns and rows, which run upwards in the picture.
  [[nodiscard]] Point pixel(const Point& place) const {
    return {kMargin + cell_.x() * place.x(), kMargin + height_ - cell_.y() * place.y()};
  }
  [[nodiscard]] Point point_place(Index k) const {
    const Index row = k / chart_.grid.n_columns;
    const Index column = k % chart_.grid.n_columns;
    return {static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5};
  }

  void add_cells() {
    add("<g shape-rendering=\"crispEdges\">\n");
    for (Index k = 0; k < chart_.grid.size(); ++k) {
      const Point corner = pixel(point_place(k) + Point(-0.5, 0.5));
      const std::string fill = is_open(chart_, k)
                                   ? color_text(position_on(scale_, chart_.values[k]), map_)
                                   : std::string(kMasked);
      add("<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" fill=\"{}\"/>\n",
          corner.x(), corner.y(), cell_.x(), cell_.y(), fill);
    }
    add("</g>\n");
  }

  void add_lines() {
    const std::vector<double> levels = chart_levels(scale_);
    std::string texts;
    for (const double level : levels) {
      const char* color = ink(position_on(scale_, level), map_);
      const auto lines = chart_lines(chart_, {level});
      if (lines.empty()) continue;
      add("<path fill=\"none\" stroke=\"{}\" stroke-width=\"1.2\" stroke-linecap=\"round\" d=\"",
          color);
      for (const ChartLine& line : lines) {
        const Point a = pixel(line.ends[0]);
        const Point b = pixel(line.ends[1]);
        add("M{:.1f} {:.1f}L{:.1f} {:.1f}", a.x(), a.y(), b.x(), b.y());
      }
      add("\"/>\n");
      add_line_label(level, lines, color, texts);
    }
    svg_ += texts;
  }

  /// In the middle of the line's pieces that is free and furthest from the edges.
  void add_line_label(double level, const std::vector<ChartLine>& lines, const char* color,
                      std::string& texts) {
    const std::string text = value_text(level);
    const double half = 0.5 * kAdvance * kFont * static_cast<double>(text.size());
    double deepest = half;
    std::optional<Label> best;
    for (const ChartLine& line : lines) {
      const Point middle = pixel(0.5 * (line.ends[0] + line.ends[1]));
      const double depth =
          std::min({middle.x() - kMargin, kMargin + width_ - middle.x(),
                    middle.y() - kMargin - kFont, kMargin + height_ - middle.y() - kFont});
      const Label label{middle, half};
      if (depth <= deepest + 1e-6 || is_taken(label)) continue;
      deepest = depth;
      best = label;
    }
    if (!best) return;
    labels_.push_back(*best);
    const char* halo = color[1] == '1' ? "#fff" : "#111";
    // Twice, for not all renderers know paint-order.
    for (const std::string& style :
         {fmt::format("fill=\"{0}\" stroke=\"{0}\" stroke-width=\"2.5\" opacity=\".6\"", halo),
          fmt::format("fill=\"{}\"", color)}) {
      texts += fmt::format(
          "<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\" font-weight=\"bold\" {}>{}"
          "</text>\n",
          best->middle.x(), best->middle.y() + 0.35 * kFont, style, text);
    }
  }

  [[nodiscard]] bool is_taken(const Label& label) const {
    return std::any_of(labels_.begin(), labels_.end(),
                       [&](const Label& other) { return label.meets(other); });
  }

  void add_value(Index k, bool is_marked) {
    Point middle = pixel(point_place(k));
    const std::string text = value_text(chart_.values[k]);
    const double half = 0.5 * kAdvance * kFont * static_cast<double>(text.size());
    const double within = std::clamp(middle.x(), kMargin + half + 3,
                                     std::max(kMargin + half + 3, kMargin + width_ - half - 3));
    if (!is_marked && within != middle.x()) return;
    middle.x() = within;
    const Label label{middle, half};
    if (is_taken(label)) return;
    labels_.push_back(label);
    const char* color = ink(position_on(scale_, chart_.values[k]), map_);
    if (is_marked) {
      add("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"none\" "
          "stroke=\"{}\"/>\n",
          middle.x() - half - 2, middle.y() - 0.65 * kFont, 2 * half + 4, 1.3 * kFont, color);
    }
    add("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\" fill=\"{}\">{}</text>\n",
        middle.x(), middle.y() + 0.35 * kFont, color, text);
  }

  /// The least and the greatest.
  void add_marks() {
    const auto summary = radiosity::summary(chart_.places, chart_.values);
    if (summary.least_at >= 0) add_value(summary.least_at, true);
    if (summary.greatest_at >= 0) add_value(summary.greatest_at, true);
  }

  void add_values() {
    for (Index k = 0; k < chart_.grid.size(); ++k) {
      if (is_open(chart_, k)) add_value(k, false);
    }
  }

  void add_frame() {
    add("<rect x=\"{0}\" y=\"{0}\" width=\"{1:.2f}\" height=\"{2:.2f}\" fill=\"none\" "
        "stroke=\"#444\"/>\n",
        kMargin, width_, height_);
    add("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">{:.4g} m</text>\n",
        kMargin + 0.5 * width_, kMargin + height_ + 15, width_ / per_metre_);
    add("<text transform=\"translate({:.1f} {:.1f}) rotate(-90)\" text-anchor=\"middle\">{:.4g} m"
        "</text>\n",
        kMargin - 8, kMargin + 0.5 * height_, height_ / per_metre_);
    add("<text x=\"{}\" y=\"{:.1f}\" fill=\"#555\">{} x {} points; framed: the least and the "
        "greatest{}</text>\n",
        kMargin, kMargin + std::max(height_, 120.0) + 34, chart_.grid.n_columns, chart_.grid.n_rows,
        radiosity::summary(chart_.places, chart_.values).n < chart_.grid.size()
            ? "; grey: not measured"
            : "");
  }

  void add_bar() {
    const double x = kMargin + width_ + 16;
    const double length = std::max(height_, 120.0);
    constexpr int kSteps = 64;
    add("<g shape-rendering=\"crispEdges\">\n");
    for (int k = 0; k < kSteps; ++k) {
      add("<rect x=\"{:.1f}\" y=\"{:.2f}\" width=\"{}\" height=\"{:.2f}\" fill=\"{}\"/>\n", x,
          kMargin + length * (kSteps - 1 - k) / kSteps, kBarWidth, length / kSteps + 0.5,
          color_text((k + 0.5) / kSteps, map_));
    }
    add("</g>\n");
    for (const double tick : tick_values(scale_, kMostLevels)) {
      const double y = kMargin + length * (1 - position_on(scale_, tick));
      add("<path stroke=\"#444\" d=\"M{0:.1f} {1:.1f}h4\"/><text x=\"{2:.1f}\" y=\"{3:.1f}\">{4}"
          "</text>\n",
          x + kBarWidth, y, x + kBarWidth + 7, y + 0.35 * kFont, value_text(tick));
    }
  }

  const GridChart& chart_;
  ColorMap map_;
  ColorScale scale_;
  double per_metre_ = 1;
  double width_ = 0;
  double height_ = 0;
  Point cell_ = Point::Zero();
  std::vector<Label> labels_;
  std::string svg_;
};

}  // namespace

std::string value_text(double value) {
  const double size = std::abs(value);
  if (size == 0) return "0";
  if (size >= 99.95 || std::abs(value - std::round(value)) < 1e-9 * size) {
    return fmt::format("{:.0f}", value);
  }
  if (size >= 9.995) return fmt::format("{:.1f}", value);
  if (size >= 0.01) return fmt::format("{:.2f}", value);
  return fmt::format("{:.2g}", value);
}

ColorScale chart_scale(const GridChart& chart) {
  std::vector<double> open;
  for (Index k = 0; k < chart.values.size(); ++k) {
    if (is_open(chart, k)) open.push_back(chart.values[k]);
  }
  const Eigen::Map<const Eigen::VectorXd> values(open.data(), static_cast<Index>(open.size()));
  return fitting_scale(values, false, {.low_percent = 0, .high_percent = 100});
}

std::vector<double> chart_levels(const ColorScale& scale) {
  std::vector<double> levels;
  for (const double tick : tick_values(scale, kMostLevels)) {
    const double position = position_on(scale, tick);
    if (position > 1e-6 && position < 1 - 1e-6) levels.push_back(tick);
  }
  return levels;
}

std::vector<ChartLine> chart_lines(const GridChart& chart, const std::vector<double>& levels) {
  std::vector<ChartLine> lines;
  const Index width = chart.grid.n_columns;
  const auto add_triangle = [&](const std::array<Index, 3>& corners, double level) {
    std::array<Point, 2> ends;
    std::size_t n = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const Index a = corners[k];
      const Index b = corners[(k + 1) % 3];
      if (!is_open(chart, a)) return;
      const double from = chart.values[a];
      const double to = chart.values[b];
      if ((from < level) == (to < level)) continue;
      const auto place = [&](Index i) {
        const auto row = i / width;
        return Point(static_cast<double>(i % width) + 0.5, static_cast<double>(row) + 0.5);
      };
      ends[n++] = place(a) + (level - from) / (to - from) * (place(b) - place(a));
    }
    if (n == 2) lines.push_back({level, ends});
  };
  for (const double level : levels) {
    for (Index r = 0; r + 1 < chart.grid.n_rows; ++r) {
      for (Index c = 0; c + 1 < width; ++c) {
        const Index k = r * width + c;
        add_triangle({k, k + 1, k + width + 1}, level);
        add_triangle({k, k + width + 1, k + width}, level);
      }
    }
  }
  return lines;
}

std::string grid_svg(const GridChart& chart, ColorMap map) { return Drawing(chart, map).svg(); }

}  // namespace io
