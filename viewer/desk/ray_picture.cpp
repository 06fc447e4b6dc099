#include "viewer/desk/ray_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "radiosity/base/parallel.h"
#include "radiosity/picture/pinhole.h"

namespace viewer {
namespace {

using radiosity::Hit;
using radiosity::Index;
using radiosity::PatchMesh;
using radiosity::Vec3;

constexpr double kEdgeWidth = 1;    // pixels
constexpr double kLargeEnough = 4;  // pixels that an edge must be apart from the opposite corner

/// Where a point lies in a patch: in the triangle of two corners and the centre (or the third
/// corner), and with which weights.
struct Place {
  int first = 0;
  int second = 1;
  double at_first = 0;
  double at_second = 0;
  double edge_distance = 0;  ///< from the edge between the two, m
};

/// Weights of a, b in the triangle a, b, c at point x of its plane.
std::array<double, 2> weights(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& normal,
                              const Vec3& x) {
  const double whole = normal.dot((b - a).cross(c - a));
  return {normal.dot((c - b).cross(x - b)) / whole, normal.dot((a - c).cross(x - c)) / whole};
}

class RayPainter {
 public:
  RayPainter(const PatchMesh& mesh, const radiosity::Visibility& visibility,
             const CornerColors& corners, const radiosity::Camera& camera,
             const RayPictureOptions& options)
      : mesh_(mesh),
        visibility_(visibility),
        corners_(corners),
        options_(options),
        pinhole_(camera, options.width, options.height) {}

  /// Mean sRGB over the samples of a pixel, as antialiasing by a graphics card has it.
  [[nodiscard]] io::Rgb pixel(int x, int y) const {
    const int n = options_.samples;
    Eigen::Array3d sum = Eigen::Array3d::Zero();
    for (int k = 0; k < n * n; ++k) {
      sum += seen(pinhole_.direction(x + (k % n + 0.5) / n, y + (k / n + 0.5) / n));
    }
    io::Rgb result{};
    for (int c = 0; c < 3; ++c) {
      result[c] = static_cast<std::uint8_t>(std::lround(sum[c] / (n * n)));
    }
    return result;
  }

 private:
  static Eigen::Array3d array(const io::Rgb& color) {
    return {1.0 * color[0], 1.0 * color[1], 1.0 * color[2]};
  }

  [[nodiscard]] Eigen::Array3d seen(const Vec3& ray) const {
    const Vec3& position = pinhole_.position();
    const std::optional<Hit> hit = options_.hides_backs ? visibility_.first_front_hit(position, ray)
                                                        : visibility_.first_hit(position, ray);
    if (!hit) return array(kBackgroundColor);
    const Vec3 point = position + hit->distance * ray;
    const bool is_back = !hit->front;
    const Place place = find_place(hit->patch, point);
    if (options_.has_edges) {
      // Of a pixel, there.
      const double size = pinhole_.pixel_size(ray, hit->distance);
      const bool is_large = std::sqrt(mesh_.area[hit->patch]) > kLargeEnough * size;
      if (is_large && place.edge_distance < 0.5 * kEdgeWidth * size) return array(kEdgeColor);
    }
    return is_back ? array(kBackColor) : color_at(hit->patch, place);
  }

  [[nodiscard]] Place find_place(Index patch, const Vec3& point) const {
    const int n = mesh_.n_corners(patch);
    Vec3 center = mesh_.corner(patch, 0);
    for (int k = 1; k < n; ++k) center += mesh_.corner(patch, k);
    center /= n;
    Place best;
    double most = -std::numeric_limits<double>::infinity();
    double nearest = std::numeric_limits<double>::infinity();
    for (int k = 0; k < n; ++k) {
      const Vec3& a = mesh_.corner(patch, k);
      const Vec3& b = mesh_.corner(patch, (k + 1) % n);
      const auto [at_a, at_b] = weights(a, b, center, mesh_.normal[patch], point);
      // The triangle that holds it is the one in which neither is negative.
      if (std::min(at_a, at_b) > most) {
        most = std::min(at_a, at_b);
        best.first = k;
        best.second = (k + 1) % n;
        best.at_first = std::clamp(at_a, 0.0, 1.0);
        best.at_second = std::clamp(at_b, 0.0, 1.0 - best.at_first);
      }
      nearest = std::min(nearest, (point - a).cross(b - a).norm() / (b - a).norm());
    }
    best.edge_distance = nearest;
    return best;
  }

  /// Blends the corners' values at a place; the centre has their mean.
  template <typename Value, typename Get>
  Value blend(Index patch, const Place& place, const Get& get) const {
    const int n = mesh_.n_corners(patch);
    Value mean = get(4 * patch);
    for (int k = 1; k < n; ++k) mean += get(4 * patch + k);
    mean /= n;
    return mean + place.at_first * (get(4 * patch + place.first) - mean) +
           place.at_second * (get(4 * patch + place.second) - mean);
  }

  [[nodiscard]] Eigen::Array3d color_at(Index patch, const Place& place) const {
    if (corners_.positions.empty()) {
      return blend<Eigen::Array3d>(
          patch, place, [&](Index slot) -> Eigen::Array3d { return array(corners_.colors[slot]); });
    }
    for (int k = 0; k < mesh_.n_corners(patch); ++k) {
      if (corners_.positions[4 * patch + k] < 0) return array(kUnknownColor);
    }
    const auto position = blend<double>(
        patch, place, [&](Index slot) { return static_cast<double>(corners_.positions[slot]); });
    return array(io::map_color(position, corners_.map));
  }

  const PatchMesh& mesh_;
  const radiosity::Visibility& visibility_;
  const CornerColors& corners_;
  const RayPictureOptions& options_;
  radiosity::Pinhole pinhole_;
};

}  // namespace

io::RgbPicture ray_picture(const PatchMesh& mesh, const radiosity::Visibility& visibility,
                           const CornerColors& corners, const radiosity::Camera& camera,
                           const RayPictureOptions& options) {
  io::RgbPicture picture{.width = options.width, .height = options.height, .bytes = {}};
  picture.bytes.resize(3 * static_cast<std::size_t>(options.width) * options.height);
  const RayPainter painter(mesh, visibility, corners, camera, options);
  radiosity::parallel_for(options.height, [&](std::ptrdiff_t y) {
    options.progress.check();
    for (int x = 0; x < options.width; ++x) {
      const io::Rgb color = painter.pixel(x, static_cast<int>(y));
      std::copy(color.begin(), color.end(), picture.bytes.begin() + 3 * (y * options.width + x));
    }
  });
  return picture;
}

}  // namespace viewer
