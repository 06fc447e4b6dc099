#include "viewer/desk/ray_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "radiosity/base/parallel.h"
#include "radiosity/picture/pinhole.h"
#include "viewer/desk/outlines.h"

namespace viewer {
namespace {

using radiosity::Hit;
using radiosity::Index;
using radiosity::PatchMesh;
using radiosity::Vec3;

constexpr double kIsolineWidth = 1.5;   // times that of edges
constexpr double kIsolineReach = 0.05;  // of the colour map, beyond which none is looked for
constexpr double kJump = 4;             // pixels that one surface lies behind another
constexpr double kOutlineShare = 0.8;   // of an outline's colour, over what is there
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
    for (int row = 0; row < n; ++row) {
      for (int column = 0; column < n; ++column) {
        sum += seen({x + (column + 0.5) / n, y + (row + 0.5) / n});
      }
    }
    io::Rgb result{};
    for (int c = 0; c < 3; ++c) {
      result[c] = static_cast<std::uint8_t>(std::lround(sum[c] / (n * n)));
    }
    return result;
  }

  /// What the middle of a pixel sees, of which outlines are found.
  [[nodiscard]] std::optional<Hit> middle(int x, int y) const {
    return hit(pinhole_.direction(x + 0.5, y + 0.5));
  }

  /// Whether an outline runs between two neighbouring pixels: what they see lies on surfaces that
  /// bend more than a curved one does, or one behind the other.
  [[nodiscard]] bool is_outline(int x, int y, const std::optional<Hit>& here, int other_x,
                                int other_y, const std::optional<Hit>& there) const {
    if (here.has_value() != there.has_value()) return true;
    if (!here || here->patch == there->patch) return false;
    const Vec3& normal = mesh_.normal[here->patch];
    const Vec3& other_normal = mesh_.normal[there->patch];
    if (mesh_.surface[here->patch] != mesh_.surface[there->patch]) return true;
    if (normal.dot(other_normal) < std::cos(kCreaseAngle)) return true;
    const Vec3 ray = pinhole_.direction(x + 0.5, y + 0.5);
    const Vec3 apart =
        there->distance * pinhole_.direction(other_x + 0.5, other_y + 0.5) - here->distance * ray;
    const double step = kJump * pinhole_.pixel_size(ray, here->distance);
    return std::abs(normal.dot(apart)) > step && std::abs(other_normal.dot(apart)) > step;
  }

 private:
  static Eigen::Array3d array(const io::Rgb& color) {
    return {1.0 * color[0], 1.0 * color[1], 1.0 * color[2]};
  }

  [[nodiscard]] std::optional<Hit> hit(const Vec3& ray) const {
    return first_seen(visibility_, mesh_, options_.hidden,
                      options_.hides_backs ? Backs::hidden : Backs::shown, pinhole_.position(),
                      ray);
  }

  /// At a place of the picture, pixels.
  [[nodiscard]] Eigen::Array3d seen(const Eigen::Vector2d& pixel) const {
    const Vec3 ray = pinhole_.direction(pixel.x(), pixel.y());
    const Vec3& position = pinhole_.position();
    const std::optional<Hit> hit = this->hit(ray);
    if (!hit) return array(kBackgroundColor);
    const Vec3 point = position + hit->distance * ray;
    const bool is_back = !hit->front;
    const Place place = find_place(hit->patch, point);
    if (options_.has_edges) {
      // Of a pixel, there.
      const double size = pinhole_.pixel_size(ray, hit->distance);
      const bool is_large = std::sqrt(mesh_.area[hit->patch]) > kLargeEnough * size;
      if (is_large && place.edge_distance < 0.5 * options_.line_width * size)
        return array(kEdgeColor);
    }
    return is_back ? array(kBackColor) : color_at(hit->patch, place, pixel);
  }

  [[nodiscard]] Place find_place(Index patch, const Vec3& point) const {
    const int n = mesh_.n_corners(patch);
    const Vec3 middle = center(patch);
    Place best;
    double most = -std::numeric_limits<double>::infinity();
    double nearest = std::numeric_limits<double>::infinity();
    for (int k = 0; k < n; ++k) {
      const Vec3& a = mesh_.corner(patch, k);
      const Vec3& b = mesh_.corner(patch, (k + 1) % n);
      const auto [at_a, at_b] = weights(a, b, middle, mesh_.normal[patch], point);
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

  [[nodiscard]] Eigen::Array3d color_at(Index patch, const Place& place,
                                        const Eigen::Vector2d& pixel) const {
    if (corners_.positions.empty()) {
      return blend<Eigen::Array3d>(
          patch, place, [&](Index slot) -> Eigen::Array3d { return array(corners_.colors[slot]); });
    }
    for (int k = 0; k < mesh_.n_corners(patch); ++k) {
      if (corners_.positions[4 * patch + k] < 0) return array(kUnknownColor);
    }
    const double value = map_position(patch, place);
    for (const IsoLevel& level : corners_.levels) {
      // The change from pixel to pixel tells how wide a line is that is as wide everywhere.
      if (std::abs(value - level.position) > kIsolineReach) continue;
      const double right = map_position(patch, place_at(patch, place, pixel, {1, 0}));
      const double down = map_position(patch, place_at(patch, place, pixel, {0, 1}));
      const double change = std::hypot(right - value, down - value);
      if (std::abs(value - level.position) < 0.5 * kIsolineWidth * options_.line_width * change) {
        return array(isoline_color(level.position, corners_.map));
      }
    }
    return array(io::map_color(value, corners_.map));
  }

  [[nodiscard]] double map_position(Index patch, const Place& place) const {
    return blend<double>(patch, place,
                         [&](Index slot) { return static_cast<double>(corners_.positions[slot]); });
  }

  /// What another place of the picture sees of the same triangle's plane, also beyond its edges.
  [[nodiscard]] Place place_at(Index patch, Place place, const Eigen::Vector2d& pixel,
                               const Eigen::Vector2d& step) const {
    const Vec3& normal = mesh_.normal[patch];
    const Vec3& a = mesh_.corner(patch, place.first);
    const Vec3 ray = pinhole_.direction(pixel.x() + step.x(), pixel.y() + step.y());
    const double distance = normal.dot(a - pinhole_.position()) / normal.dot(ray);
    const Vec3 point = pinhole_.position() + distance * ray;
    const auto [at_a, at_b] =
        weights(a, mesh_.corner(patch, place.second), center(patch), normal, point);
    place.at_first = at_a;
    place.at_second = at_b;
    return place;
  }

  /// The mean of the corners.
  [[nodiscard]] Vec3 center(Index patch) const {
    const int n = mesh_.n_corners(patch);
    Vec3 sum = mesh_.corner(patch, 0);
    for (int k = 1; k < n; ++k) sum += mesh_.corner(patch, k);
    return sum / n;
  }

  const PatchMesh& mesh_;
  const radiosity::Visibility& visibility_;
  const CornerColors& corners_;
  const RayPictureOptions& options_;
  radiosity::Pinhole pinhole_;
};

/// Draws outlines over a picture of them.
void draw_outlines(io::RgbPicture& picture, const RayPainter& painter, double line_width,
                   const radiosity::Progress& progress) {
  const int width = picture.width;
  const int height = picture.height;
  std::vector<std::optional<Hit>> hits(static_cast<std::size_t>(width) * height);
  radiosity::parallel_for(height, [&](std::ptrdiff_t y) {
    progress.check();
    for (int x = 0; x < width; ++x) hits[y * width + x] = painter.middle(x, static_cast<int>(y));
  });
  std::vector<std::uint8_t> is_line(hits.size());
  radiosity::parallel_for(height, [&](std::ptrdiff_t row) {
    const int y = static_cast<int>(row);
    const auto is_line_to = [&](int x, int other_x, int other_y) {
      return other_x < width && other_y < height &&
             painter.is_outline(x, y, hits[row * width + x], other_x, other_y,
                                hits[static_cast<std::ptrdiff_t>(other_y) * width + other_x]);
    };
    for (int x = 0; x < width; ++x) {
      is_line[row * width + x] = is_line_to(x, x + 1, y) || is_line_to(x, x, y + 1) ? 1 : 0;
    }
  });
  const int thickness = std::max(1, static_cast<int>(std::lround(line_width)));
  radiosity::parallel_for(height, [&](std::ptrdiff_t row) {
    for (int x = 0; x < width; ++x) {
      bool is_near = false;  // to a pixel that a line begins at
      for (std::ptrdiff_t y = std::max<std::ptrdiff_t>(0, row - thickness + 1); y <= row; ++y) {
        const auto* line = is_line.data() + y * width;
        is_near |=
            std::find(line + std::max(0, x - thickness + 1), line + x + 1, 1) != line + x + 1;
      }
      if (!is_near) continue;
      for (int c = 0; c < 3; ++c) {
        std::uint8_t& byte = picture.bytes[3 * (row * width + x) + c];
        byte = static_cast<std::uint8_t>(
            std::lround(kOutlineShare * kOutlineColor[c] + (1 - kOutlineShare) * byte));
      }
    }
  });
}

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
  if (options.has_outlines) draw_outlines(picture, painter, options.line_width, options.progress);
  return picture;
}

}  // namespace viewer
