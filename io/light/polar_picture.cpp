#include "io/light/polar_picture.h"

#include <algorithm>
#include <cmath>

#include "io/light/polar_drawing.h"
#include "io/picture/image_file.h"
#include "io/picture/text_raster.h"

namespace io {
namespace {

using Place = Eigen::Vector2d;

/// A white picture that is drawn upon.
class Canvas {
 public:
  explicit Canvas(int size) {
    picture_ = {size, size, std::vector<std::uint8_t>(std::size_t{3} * size * size, 255)};
  }

  void draw(const PolarDrawing::Line& line) {
    double way = 0;
    for (std::size_t k = 1; k < line.points.size(); ++k) {
      const Place& from = line.points[k - 1];
      const Place& to = line.points[k];
      const bool is_gap = line.is_dashed && std::fmod(way, kDash + kGap) >= kDash;
      if (!is_gap) draw_segment(from, to, line.width, line.color);
      way += (to - from).norm();
    }
  }

  void draw(const PolarDrawing::Label& label) {
    const TextRaster text = rasterize(label.text, label.size);
    const int left = static_cast<int>(std::lround(label.place.x() - label.anchor * text.width));
    const int top = static_cast<int>(std::lround(label.place.y())) - kAscent * text.height / 100;
    for (int y = 0; y < text.height; ++y) {
      for (int x = 0; x < text.width; ++x) {
        const std::size_t k = static_cast<std::size_t>(y) * text.width + x;
        blend(left + x, top + y, text.coverage[k] / 255.0, label.color);
      }
    }
  }

  [[nodiscard]] const RgbPicture& picture() const { return picture_; }

 private:
  static constexpr double kDash = 6;  // pixels
  static constexpr double kGap = 4;
  static constexpr int kAscent = 80;  // % of a text's height above its base line

  void blend(int x, int y, double share, const Rgb& color) {
    if (x < 0 || y < 0 || x >= picture_.width || y >= picture_.height || !(share > 0)) return;
    std::uint8_t* pixel = &picture_.bytes[3 * (static_cast<std::size_t>(y) * picture_.width + x)];
    for (std::size_t c = 0; c < 3; ++c) {
      pixel[c] = static_cast<std::uint8_t>(std::lround(pixel[c] + share * (color[c] - pixel[c])));
    }
  }

  /// Covers pixels by how far their middles are from the segment.
  void draw_segment(const Place& from, const Place& to, double width, const Rgb& color) {
    const double reach = 0.5 * width + 0.5;
    const Place along = to - from;
    const double length2 = along.squaredNorm();
    const Place low = from.cwiseMin(to).array() - reach;
    const Place high = from.cwiseMax(to).array() + reach;
    for (int y = static_cast<int>(low.y()); y <= static_cast<int>(high.y()); ++y) {
      for (int x = static_cast<int>(low.x()); x <= static_cast<int>(high.x()); ++x) {
        const Place pixel(x + 0.5, y + 0.5);
        const double t =
            length2 > 0 ? std::clamp((pixel - from).dot(along) / length2, 0.0, 1.0) : 0;
        const double distance = (pixel - from - t * along).norm();
        blend(x, y, std::min(1.0, reach - distance), color);
      }
    }
  }

  RgbPicture picture_;
};

}  // namespace

void write_polar_picture(const std::filesystem::path& path,
                         const radiosity::Photometry& photometry) {
  const PolarDrawing drawing = polar_drawing(photometry);
  Canvas canvas(drawing.size);
  for (const PolarDrawing::Line& line : drawing.lines) canvas.draw(line);
  for (const PolarDrawing::Label& label : drawing.labels) canvas.draw(label);
  write_png(path, canvas.picture());
}

}  // namespace io
