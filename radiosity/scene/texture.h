#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace radiosity {

/// A picture of reflectances: rows of square texels from the top, each of one value in linear RGB,
/// with sums that make integrals over any part of it cheap.
class TextureImage {
 public:
  /// Three values of sRGB a texel (IEC 61966-2-1), row by row from the top; sizes > 0.
  TextureImage(int width, int height, std::vector<std::uint8_t> srgb);

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }

  /// Linear RGB, and its squares: of one texel, and of all texels of a row before a column.
  using Sums = Eigen::Array<double, 6, 1>;
  [[nodiscard]] Sums texel(int column, int row) const;
  [[nodiscard]] Sums before(int column, int row) const;  ///< 0 <= column <= width

 private:
  static constexpr int kStride = 32;  // texels from one stored sum to the next

  int width_;
  int height_;
  int n_stored_;  // sums of each row
  std::vector<std::uint8_t> srgb_;
  std::vector<Sums> sums_;
};

/// How a texture goes on beyond its picture.
enum class TextureWrap { repeat, clamp, mirror };

/// What a material reflects from place to place: a factor times a picture.
struct Texture {
  /// Shared, for scenes are copied for each scenario, and pictures are large.
  std::shared_ptr<const TextureImage> image;
  Eigen::Array3d factor = Eigen::Array3d::Ones();  ///< in [0, 1], linear RGB
  TextureWrap across = TextureWrap::repeat;        ///< along u
  TextureWrap down = TextureWrap::repeat;          ///< along v
};

/// Reflectance within a part of a texture.
struct TextureMean {
  Eigen::Array3d mean = Eigen::Array3d::Zero();    ///< linear RGB
  Eigen::Array3d square = Eigen::Array3d::Zero();  ///< the mean of the squares
};

/// How far apart texture coordinates may lie, in texels along all edges of a polygon together.
inline constexpr double kMostTexels = 1e7;

/// What is reflected at texture coordinates, which must be finite.
Eigen::Array3d texture_value(const Texture& texture, const Eigen::Vector2d& coordinate);

/// Of a simple polygon in texture coordinates: u from 0 to 1 across the picture, v down. Exact but
/// for rounding: ∬ f du dv = ∮ F dv along the outline with F = ∫ f du, which is linear in u within
/// each texel. Of outlines without area, whose texture is drawn out along a line, from points
/// spread evenly over the polygon that they are of. Coordinates must be finite and span no more
/// than kMostTexels.
TextureMean texture_mean(const Texture& texture, std::span<const Eigen::Vector2d> outline);

/// Of the whole picture.
TextureMean texture_mean(const Texture& texture);

}  // namespace radiosity
