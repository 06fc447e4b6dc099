#include "radiosity/scene/texture.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

namespace radiosity {
namespace {

using Sums = TextureImage::Sums;
using Eigen::Vector2d;

/// Outlines whose area is less than this share of their length squared count as lines.
constexpr double kFlatOutline = 1e-6;
/// Points along each side of a triangle whose texture is drawn out along a line.
constexpr int kLinePoints = 16;

/// IEC 61966-2-1.
double linear_of(int byte) {
  const double s = byte / 255.0;
  return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
}

double linear(std::uint8_t byte) {
  static const std::array<double, 256> kLinearOfByte = [] {
    std::array<double, 256> table{};
    for (int k = 0; k < 256; ++k) table[static_cast<std::size_t>(k)] = linear_of(k);
    return table;
  }();
  return kLinearOfByte[byte];
}

/// A texture in texels, going on beyond its picture.
class EndlessTexture {
 public:
  explicit EndlessTexture(const Texture& texture)
      : image_(*texture.image),
        across_(texture.across),
        down_(texture.down),
        width_(image_.width()),
        height_(image_.height()) {}

  /// ∫ of row `row` from 0 to x.
  [[nodiscard]] Sums integral(double x, double row) const {
    const int y = place(row, height_, down_);
    switch (across_) {
      case TextureWrap::clamp:
        if (x < 0) return x * image_.texel(0, y);
        if (x > width_) return inside(width_, y) + (x - width_) * image_.texel(width_ - 1, y);
        return inside(x, y);
      case TextureWrap::repeat: {
        const double n = std::floor(x / width_);
        return n * inside(width_, y) + inside(x - n * width_, y);
      }
      case TextureWrap::mirror:
        break;
    }
    const double n = std::floor(x / (2 * width_));
    const double rest = x - n * 2 * width_;
    const Sums whole = inside(width_, y);
    return 2 * n * whole +
           (rest <= width_ ? inside(rest, y) : Sums(2 * whole - inside(2 * width_ - rest, y)));
  }

  /// By whole numbers.
  [[nodiscard]] Sums texel(double column, double row) const {
    return image_.texel(place(column, width_, across_), place(row, height_, down_));
  }
  [[nodiscard]] Sums at(const Vector2d& point) const {
    return texel(std::floor(point.x()), std::floor(point.y()));
  }

 private:
  [[nodiscard]] Sums inside(double x, int y) const {
    const double in = std::clamp(x, 0.0, static_cast<double>(width_));  // of rounding
    const int column = std::min(static_cast<int>(in), width_ - 1);
    return image_.before(column, y) + (in - column) * image_.texel(column, y);
  }

  /// The texel of the picture for one of the endless row, `k` a whole number.
  static int place(double k, int n, TextureWrap wrap) {
    if (wrap == TextureWrap::clamp) {
      return static_cast<int>(std::clamp(k, 0.0, static_cast<double>(n - 1)));
    }
    const double period = wrap == TextureWrap::repeat ? n : 2.0 * n;
    const double rest = k - period * std::floor(k / period);
    const int in = std::clamp(static_cast<int>(rest), 0, static_cast<int>(period) - 1);
    return in < n ? in : 2 * n - 1 - in;
  }

  const TextureImage& image_;
  TextureWrap across_;
  TextureWrap down_;
  int width_;
  int height_;
};

/// The parameter at which a + t d next meets a whole number, counted by `k`, along one axis.
struct Crossings {
  double a;
  double d;
  double next;  // whole number

  Crossings(double start, double way)
      : a(start), d(way), next(way > 0 ? std::floor(start) + 1 : std::ceil(start) - 1) {}
  [[nodiscard]] double parameter() const {
    return d == 0 ? std::numeric_limits<double>::infinity() : (next - a) / d;
  }
  void advance() { next += d > 0 ? 1 : -1; }
};

/// Integrals of rows from one column on, which keeps digits. Places that are asked for one after
/// the other are close by each other, so that few texels are between them.
class RowIntegral {
 public:
  RowIntegral(const EndlessTexture& texture, double origin) : texture_(texture), origin_(origin) {}

  /// ∫ of row `row` from the origin to x.
  Sums operator()(double x, double row) {
    constexpr double kFar = 64;  // columns
    const double column = std::floor(x);
    if (row != row_) {
      row_ = row;
      column_ = origin_;
      sum_.setZero();
    }
    if (std::abs(column - column_) > kFar) {
      column_ = column;
      sum_ = texture_.integral(column, row) - texture_.integral(origin_, row);
    }
    for (; column_ < column; ++column_) sum_ += texture_.texel(column_, row);
    while (column_ > column) sum_ -= texture_.texel(--column_, row);
    return sum_ + (x - column) * texture_.texel(column, row);
  }

 private:
  const EndlessTexture& texture_;
  double origin_;
  double row_ = std::numeric_limits<double>::quiet_NaN();
  double column_ = 0;
  Sums sum_ = Sums::Zero();  // from the origin to column_
};

/// ∫ F dy along an edge.
Sums edge_integral(RowIntegral& integral, const Vector2d& from, const Vector2d& to) {
  Sums sum = Sums::Zero();
  const Vector2d way = to - from;
  if (way.y() == 0) return sum;
  Crossings x(from.x(), way.x());
  Crossings y(from.y(), way.y());
  for (double t = 0; t < 1;) {
    const double next_x = x.parameter();
    const double next_y = y.parameter();
    const double end = std::min({next_x, next_y, 1.0});
    if (next_x <= end) x.advance();
    if (next_y <= end) y.advance();
    if (!(end > t)) continue;  // of rounding
    const Vector2d middle = from + (t + end) / 2 * way;
    const double row = std::floor(middle.y());
    sum += (end - t) * way.y() * integral(middle.x(), row);
    t = end;
  }
  return sum;
}

/// From points spread over the triangles of the outline, which in space have equal shares of it
/// where it is a triangle or a parallelogram.
Sums point_sum(const EndlessTexture& texture, std::span<const Vector2d> outline) {
  Sums sum = Sums::Zero();
  long n = 0;
  for (std::size_t k = 2; k < outline.size(); ++k) {
    const Vector2d first = (outline[k - 1] - outline[0]) / kLinePoints;
    const Vector2d second = (outline[k] - outline[0]) / kLinePoints;
    for (int i = 0; i < kLinePoints; ++i) {
      for (int j = 0; j < kLinePoints - i; ++j, ++n) {
        sum += texture.at(outline[0] + (i + 1. / 3) * first + (j + 1. / 3) * second);
        if (i + j + 1 == kLinePoints) continue;
        sum += texture.at(outline[0] + (i + 2. / 3) * first + (j + 2. / 3) * second);
        ++n;
      }
    }
  }
  return sum / static_cast<double>(n);
}

/// Means lie in [0, 1] but for rounding.
TextureMean scaled(const Sums& mean, const Eigen::Array3d& factor) {
  const Sums rounded = mean.max(0).min(1);
  return {.mean = factor * rounded.head<3>(), .square = factor.square() * rounded.tail<3>()};
}

}  // namespace

TextureImage::TextureImage(int width, int height, std::vector<std::uint8_t> srgb)
    : width_(width),
      height_(height),
      n_stored_((width + kStride - 1) / kStride + 1),
      srgb_(std::move(srgb)) {
  assert(width > 0 && height > 0);
  assert(srgb_.size() == 3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  sums_.reserve(static_cast<std::size_t>(n_stored_) * static_cast<std::size_t>(height));
  for (int row = 0; row < height; ++row) {
    Sums sum = Sums::Zero();
    for (int column = 0; column < width; ++column) {
      if (column % kStride == 0) sums_.push_back(sum);
      sum += texel(column, row);
    }
    // The last one is of the whole row, wherever that ends.
    sums_.push_back(sum);
  }
}

Sums TextureImage::texel(int column, int row) const {
  const std::size_t first = 3 * (static_cast<std::size_t>(row) * static_cast<std::size_t>(width_) +
                                 static_cast<std::size_t>(column));
  Sums sums;
  for (Eigen::Index k = 0; k < 3; ++k) {
    sums[k] = linear(srgb_[first + static_cast<std::size_t>(k)]);
  }
  sums.tail<3>() = sums.head<3>().square();
  return sums;
}

Sums TextureImage::before(int column, int row) const {
  const std::size_t first = static_cast<std::size_t>(row) * static_cast<std::size_t>(n_stored_);
  if (column == width_) return sums_[first + static_cast<std::size_t>(n_stored_ - 1)];
  const int stored = column / kStride;
  Sums sum = sums_[first + static_cast<std::size_t>(stored)];
  for (int k = stored * kStride; k < column; ++k) sum += texel(k, row);
  return sum;
}

Eigen::Array3d texture_value(const Texture& texture, const Vector2d& coordinate) {
  const Vector2d size(texture.image->width(), texture.image->height());
  const Sums there = EndlessTexture(texture).at(coordinate.cwiseProduct(size));
  return texture.factor * there.head<3>();
}

TextureMean texture_mean(const Texture& texture, std::span<const Vector2d> outline) {
  const EndlessTexture endless(texture);
  const Vector2d size(texture.image->width(), texture.image->height());
  std::vector<Vector2d> texels;
  Vector2d least = Vector2d::Constant(std::numeric_limits<double>::infinity());
  for (const Vector2d& point : outline) {
    texels.emplace_back(point.cwiseProduct(size));
    least = least.cwiseMin(texels.back());
  }
  // Whole periods change nothing and cost digits.
  Vector2d shift = Vector2d::Zero();
  const std::array wraps = {texture.across, texture.down};
  for (Eigen::Index k = 0; k < 2; ++k) {
    if (wraps[static_cast<std::size_t>(k)] == TextureWrap::clamp) continue;
    shift[k] = 2 * size[k] * std::floor(least[k] / (2 * size[k]));
  }
  Vector2d lowest = Vector2d::Constant(std::numeric_limits<double>::infinity());
  Vector2d highest = -lowest;
  for (Vector2d& point : texels) {
    point -= shift;
    lowest = lowest.cwiseMin(point);
    highest = highest.cwiseMax(point);
  }
  if ((lowest.array().floor() == highest.array().floor()).all()) {
    return scaled(endless.at(lowest), texture.factor);
  }
  double area = 0;
  double length = 0;
  for (std::size_t k = 0; k < texels.size(); ++k) {
    const Vector2d a = texels[k] - lowest;
    const Vector2d b = texels[(k + 1) % texels.size()] - lowest;
    area += (a.x() * b.y() - a.y() * b.x()) / 2;
    length += (b - a).norm();
  }
  if (!(std::abs(area) > kFlatOutline * length * length)) {
    return scaled(point_sum(endless, texels), texture.factor);
  }
  RowIntegral integral(endless, std::floor(lowest.x()));
  Sums sum = Sums::Zero();
  for (std::size_t k = 0; k < texels.size(); ++k) {
    sum += edge_integral(integral, texels[k], texels[(k + 1) % texels.size()]);
  }
  return scaled(sum / area, texture.factor);
}

TextureMean texture_mean(const Texture& texture) {
  const TextureImage& image = *texture.image;
  Sums sum = Sums::Zero();
  for (int row = 0; row < image.height(); ++row) sum += image.before(image.width(), row);
  const double n = static_cast<double>(image.width()) * image.height();
  return scaled(sum / n, texture.factor);
}

}  // namespace radiosity
