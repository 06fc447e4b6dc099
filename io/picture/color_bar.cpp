#include "io/picture/color_bar.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/picture/text_raster.h"

namespace io {
namespace {

constexpr Rgb kPaper = {255, 255, 255};
constexpr Rgb kInk = {0, 0, 0};

void set_pixel(RgbPicture& picture, int x, int y, const Rgb& color) {
  if (x < 0 || y < 0 || x >= picture.width || y >= picture.height) return;
  std::copy(color.begin(), color.end(),
            picture.bytes.begin() + 3 * (static_cast<std::ptrdiff_t>(y) * picture.width + x));
}

void draw_text(RgbPicture& picture, const TextRaster& text, int left, int top) {
  for (int y = 0; y < text.height; ++y) {
    for (int x = 0; x < text.width; ++x) {
      const int shade = 255 - text.coverage[static_cast<std::size_t>(y) * text.width + x];
      if (shade == 255) continue;
      const auto grey = static_cast<std::uint8_t>(shade);
      set_pixel(picture, left + x, top + y, {grey, grey, grey});
    }
  }
}

struct Label {
  double position;  ///< on the scale, 0 to 1
  TextRaster text;
};

/// Where everything stands, in pixels from the top left of the panel.
struct Layout {
  int text_size;
  int line_height;
  int margin;
  int bar_left;
  int bar_width;
  int bar_top;     ///< row of the scale's high end
  int bar_bottom;  ///< row of its low end
  int arrow;       ///< height of the arrows for values beyond the scale
  int tick;        ///< length of a tick

  [[nodiscard]] int row_of(double position) const {
    return bar_bottom - static_cast<int>(std::lround(position * (bar_bottom - bar_top)));
  }
  [[nodiscard]] int label_left() const { return bar_left + bar_width + 2 * tick; }
};

Layout make_layout(int height, std::size_t n_title_lines) {
  Layout layout{};
  layout.text_size = std::clamp(height / 32, 11, 28);
  layout.line_height = layout.text_size + layout.text_size / 4;
  layout.margin = layout.text_size / 2 + 2;
  layout.bar_left = layout.margin;
  layout.bar_width = layout.text_size + layout.text_size / 3;
  layout.tick = std::max(2, layout.text_size / 4);
  layout.arrow = layout.text_size * 2 / 3;
  layout.bar_top = layout.margin + static_cast<int>(n_title_lines) * layout.line_height +
                   layout.margin / 2 + layout.arrow;
  layout.bar_bottom = std::max(layout.bar_top + 8, height - 1 - layout.margin - layout.arrow);
  return layout;
}

std::vector<Label> make_labels(const ColorBar& bar, const Layout& layout) {
  const int room = (layout.bar_bottom - layout.bar_top) / (2 * layout.line_height) + 1;
  std::vector<Label> labels;
  for (const double tick : tick_values(bar.scale, std::clamp(room, 2, 11))) {
    labels.push_back({position_on(bar.scale, tick), rasterize(tick_label(tick), layout.text_size)});
  }
  return labels;
}

/// A triangle on an end of the bar in the end's colour; `step` is -1 upwards, 1 downwards.
void draw_arrow(RgbPicture& picture, const Layout& layout, int left, int row, int step,
                const Rgb& color) {
  for (int k = 1; k <= layout.arrow; ++k) {
    const int inset = layout.bar_width * k / (2 * layout.arrow);
    for (int x = inset; x < layout.bar_width - inset; ++x) {
      set_pixel(picture, left + x, row + step * k, color);
    }
    set_pixel(picture, left + inset - 1, row + step * k, kInk);
    set_pixel(picture, left + layout.bar_width - inset, row + step * k, kInk);
  }
}

void draw_bar(RgbPicture& picture, const ColorBar& bar, const Layout& layout, int left) {
  for (int y = layout.bar_top; y <= layout.bar_bottom; ++y) {
    const double position = static_cast<double>(layout.bar_bottom - y) /
                            std::max(1, layout.bar_bottom - layout.bar_top);
    const Rgb color = map_color(position, bar.map);
    for (int x = 0; x < layout.bar_width; ++x) set_pixel(picture, left + x, y, color);
    set_pixel(picture, left - 1, y, kInk);
    set_pixel(picture, left + layout.bar_width, y, kInk);
  }
  for (int x = -1; x <= layout.bar_width; ++x) {
    set_pixel(picture, left + x, layout.bar_top - 1, kInk);
    set_pixel(picture, left + x, layout.bar_bottom + 1, kInk);
  }
  if (bar.has_above)
    draw_arrow(picture, layout, left, layout.bar_top - 1, -1, map_color(1, bar.map));
  if (bar.has_below)
    draw_arrow(picture, layout, left, layout.bar_bottom + 1, 1, map_color(0, bar.map));
}

/// The picture on a wider sheet of paper.
RgbPicture widened(const RgbPicture& picture, int extra) {
  RgbPicture sheet = {picture.width + extra, picture.height, {}};
  sheet.bytes.reserve(3 * static_cast<std::size_t>(sheet.width) * sheet.height);
  for (int y = 0; y < picture.height; ++y) {
    const auto row = picture.bytes.begin() + 3 * static_cast<std::ptrdiff_t>(y) * picture.width;
    sheet.bytes.insert(sheet.bytes.end(), row,
                       row + 3 * static_cast<std::ptrdiff_t>(picture.width));
    for (int x = 0; x < extra; ++x) {
      sheet.bytes.insert(sheet.bytes.end(), kPaper.begin(), kPaper.end());
    }
  }
  return sheet;
}

}  // namespace

RgbPicture add_color_bar(const RgbPicture& picture, const ColorBar& bar) {
  const Layout layout = make_layout(picture.height, bar.title.size());
  const std::vector<Label> labels = make_labels(bar, layout);
  std::vector<TextRaster> title;
  for (const std::string& line : bar.title) title.push_back(rasterize(line, layout.text_size));

  int right = layout.label_left();
  for (const Label& label : labels) {
    right = std::max(right, layout.label_left() + label.text.width);
  }
  for (const TextRaster& line : title) right = std::max(right, layout.bar_left + line.width);

  RgbPicture sheet = widened(picture, right + layout.margin);
  const int origin = picture.width;
  for (std::size_t k = 0; k < title.size(); ++k) {
    draw_text(sheet, title[k], origin + layout.bar_left,
              layout.margin + static_cast<int>(k) * layout.line_height);
  }
  draw_bar(sheet, bar, layout, origin + layout.bar_left);
  for (const Label& label : labels) {
    const int row = layout.row_of(label.position);
    for (int x = 0; x < layout.tick; ++x) {
      set_pixel(sheet, origin + layout.bar_left + layout.bar_width + 1 + x, row, kInk);
    }
    // Digits fill the upper three quarters of a line.
    draw_text(sheet, label.text, origin + layout.label_left(),
              row - static_cast<int>(std::lround(0.38 * label.text.height)));
  }
  return sheet;
}

std::string tick_label(double value) {
  std::string text = fmt::format("{:.6g}", value + 0.0);  // no -0
  const auto exponent = text.find('e');
  if (exponent == std::string::npos) return text;
  const std::string digits = text.substr(0, exponent);
  return fmt::format("{}e{}", digits, std::stoi(text.substr(exponent + 1)));
}

}  // namespace io
