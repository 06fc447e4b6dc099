#include "io/picture/grid_picture.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "io/picture/color_bar.h"
#include "io/picture/image_file.h"
#include "io/picture/text_raster.h"

namespace io {
namespace {

using radiosity::Index;
using radiosity::PointPlace;

constexpr double kLargerSide = 720;  // pixels
constexpr int kLeastHeight = 128;    // that a bar can be read beside
constexpr int kTextSize = 13;
constexpr Rgb kNotMeasured = {187, 187, 187};

class Raster {
 public:
  Raster(const GridChart& chart, ColorMap map)
      : chart_(chart), map_(map), scale_(chart_scale(chart)) {
    const double width = static_cast<double>(chart.grid.n_columns) * chart.grid.column.norm();
    const double height = static_cast<double>(chart.grid.n_rows) * chart.grid.row.norm();
    const double per_metre = kLargerSide / std::max(width, height);
    picture_.width = std::max(16, static_cast<int>(std::lround(per_metre * width)));
    picture_.height = std::max(kLeastHeight, static_cast<int>(std::lround(per_metre * height)));
    picture_.bytes.resize(3 * static_cast<std::size_t>(picture_.width) *
                          static_cast<std::size_t>(picture_.height));
  }

  RgbPicture picture() {
    add_colors();
    add_values();
    return std::move(picture_);
  }

 private:
  void set(int x, int y, const Rgb& color) {
    if (x < 0 || y < 0 || x >= picture_.width || y >= picture_.height) return;
    const std::size_t first = 3 * (static_cast<std::size_t>(y) * picture_.width + x);
    std::copy(color.begin(), color.end(), picture_.bytes.begin() + static_cast<long>(first));
  }

  [[nodiscard]] bool is_open(Index column, Index row) const {
    return chart_.places[static_cast<std::size_t>(row * chart_.grid.n_columns + column)] ==
           PointPlace::open;
  }

  /// Columns from a pixel's middle, or rows, as the grid counts them.
  [[nodiscard]] double column_at(int x) const {
    return (x + 0.5) / picture_.width * static_cast<double>(chart_.grid.n_columns);
  }
  [[nodiscard]] double row_at(int y) const {
    return (picture_.height - y - 0.5) / picture_.height * static_cast<double>(chart_.grid.n_rows);
  }

  /// Blended between the four points around that are open; NaN in cells that are not measured.
  [[nodiscard]] double value_at_pixel(int x, int y) const {
    const double column = column_at(x);
    const double row = row_at(y);
    const Index own_column = std::min<Index>(static_cast<Index>(column), chart_.grid.n_columns - 1);
    const Index own_row = std::min<Index>(static_cast<Index>(row), chart_.grid.n_rows - 1);
    if (!is_open(own_column, own_row)) return std::nan("");
    double sum = 0;
    double weights = 0;
    const double left = std::floor(column - 0.5);
    const double low = std::floor(row - 0.5);
    for (int k = 0; k < 4; ++k) {
      const int up = k / 2;
      const double c = left + k % 2;
      const double r = low + up;
      const double weight = (1 - std::abs(column - 0.5 - c)) * (1 - std::abs(row - 0.5 - r));
      const Index at_column =
          std::clamp<Index>(static_cast<Index>(c), 0, chart_.grid.n_columns - 1);
      const Index at_row = std::clamp<Index>(static_cast<Index>(r), 0, chart_.grid.n_rows - 1);
      if (!is_open(at_column, at_row)) continue;
      sum += weight * chart_.values[at_row * chart_.grid.n_columns + at_column];
      weights += weight;
    }
    return weights > 0 ? sum / weights
                       : chart_.values[own_row * chart_.grid.n_columns + own_column];
  }

  [[nodiscard]] Rgb ink(double value) const {
    const Rgb under = map_color(position_on(scale_, value), map_);
    const bool is_light = 0.3 * under[0] + 0.6 * under[1] + 0.1 * under[2] > 120;
    return is_light ? Rgb{17, 17, 17} : Rgb{255, 255, 255};
  }

  /// Colours, and lines where the number of levels below changes.
  void add_colors() {
    const std::vector<double> levels = chart_levels(scale_);
    const auto n_below = [&](double value) {
      return std::lower_bound(levels.begin(), levels.end(), value) - levels.begin();
    };
    std::vector<double> above;
    for (int y = 0; y < picture_.height; ++y) {
      std::vector<double> row;
      for (int x = 0; x < picture_.width; ++x) {
        const double value = value_at_pixel(x, y);
        row.push_back(value);
        if (std::isnan(value)) {
          set(x, y, kNotMeasured);
          continue;
        }
        const auto crosses = [&](double other) {
          return !std::isnan(other) && n_below(other) != n_below(value);
        };
        const bool is_line = (x > 0 && crosses(row[static_cast<std::size_t>(x) - 1])) ||
                             (!above.empty() && crosses(above[static_cast<std::size_t>(x)]));
        set(x, y, is_line ? ink(value) : map_color(position_on(scale_, value), map_));
      }
      above = std::move(row);
    }
  }

  void add_values() {
    struct Box {
      int x, y, width, height;
    };
    std::vector<Box> taken;
    for (Index k = 0; k < chart_.grid.size(); ++k) {
      const Index column = k % chart_.grid.n_columns;
      const Index row = k / chart_.grid.n_columns;
      if (!is_open(column, row)) continue;
      const TextRaster text = rasterize(value_text(chart_.values[k]), kTextSize);
      const auto middle = [](Index i, Index n, int size) {
        return static_cast<int>((static_cast<double>(i) + 0.5) / static_cast<double>(n) * size);
      };
      const Box box{
          middle(column, chart_.grid.n_columns, picture_.width) - text.width / 2,
          picture_.height - middle(row, chart_.grid.n_rows, picture_.height) - text.height / 2,
          text.width, text.height};
      const bool is_taken = std::any_of(taken.begin(), taken.end(), [&](const Box& other) {
        return box.x < other.x + other.width + 4 && other.x < box.x + box.width + 4 &&
               box.y < other.y + other.height && other.y < box.y + box.height;
      });
      const bool is_within = box.x >= 0 && box.y >= 0 && box.x + box.width <= picture_.width &&
                             box.y + box.height <= picture_.height;
      if (is_taken || !is_within) continue;
      taken.push_back(box);
      blend(text, box.x, box.y, ink(chart_.values[k]));
    }
  }

  void blend(const TextRaster& text, int left, int top, const Rgb& color) {
    for (int y = 0; y < text.height; ++y) {
      for (int x = 0; x < text.width; ++x) {
        const double share = text.coverage[static_cast<std::size_t>(y) * text.width + x] / 255.0;
        const std::size_t first =
            3 * (static_cast<std::size_t>(top + y) * picture_.width + left + x);
        for (std::size_t c = 0; c < 3; ++c) {
          auto& byte = picture_.bytes[first + c];
          byte = static_cast<std::uint8_t>(std::lround((1 - share) * byte + share * color[c]));
        }
      }
    }
  }

  const GridChart& chart_;
  ColorMap map_;
  ColorScale scale_;
  RgbPicture picture_;
};

}  // namespace

void write_grid_picture(const std::filesystem::path& path, const GridChart& chart, ColorMap map) {
  const ColorBar bar{.scale = chart_scale(chart), .map = map, .title = {chart.title}};
  write_png(path, add_color_bar(Raster(chart, map).picture(), bar));
}

}  // namespace io
