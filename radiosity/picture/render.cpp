#include "radiosity/picture/render.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "radiosity/base/parallel.h"
#include "radiosity/picture/primary_rays.h"

namespace radiosity {
namespace {

using Vec2 = Eigen::Vector2d;

double cross(const Vec2& a, const Vec2& b) { return a[0] * b[1] - a[1] * b[0]; }

/// The smallest root in [0, 1] of a t² + b t + c = 0, allowing for rounding at the ends.
double root_in_unit_interval(double a, double b, double c) {
  const double discriminant = std::sqrt(std::max(0.0, b * b - 4 * a * c));
  const double q = -0.5 * (b + std::copysign(discriminant, b));
  const double first = q != 0 ? c / q : 0;
  const double second = a != 0 ? q / a : first;
  const auto distance = [](double t) { return std::abs(t - 0.5); };
  return std::clamp(distance(first) <= distance(second) ? first : second, 0.0, 1.0);
}

/// Coordinates (s, t) in [0, 1]² of a point in a planar convex quad a, b, c, d, such that it is
/// (1-t) ((1-s) a + s b) + t ((1-s) d + s c).
Vec2 quad_coordinates(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d, const Vec2& x) {
  // With e = b - a, f = d - a, g = a - b + c - d the point is a + s e + t f + s t g; the cross
  // product with e + t g removes s and leaves a quadratic in t.
  const Vec2 e = b - a;
  const Vec2 f = d - a;
  const Vec2 g = a - b + c - d;
  const Vec2 h = x - a;
  const double t = root_in_unit_interval(cross(f, g), cross(f, e) - cross(h, g), -cross(h, e));
  const Vec2 side = e + t * g;
  const double s = side.dot(h - t * f) / side.squaredNorm();
  return {std::clamp(s, 0.0, 1.0), t};
}

Eigen::RowVectorXd mix(const Eigen::RowVectorXd& a, const Eigen::RowVectorXd& b, double t) {
  return a + t * (b - a);
}

/// The corner values of a patch (rows 4 i ...) interpolated to a point on it.
Eigen::RowVectorXd interpolate(const PatchMesh& mesh, const Eigen::MatrixXd& corners, Index i,
                               const Vec3& point) {
  const Vec3 axis = mesh.normal[i].unitOrthogonal();
  const Vec3 other_axis = mesh.normal[i].cross(axis);
  const auto flat = [&](const Vec3& x) -> Vec2 {
    const Vec3 offset = x - mesh.corner(i, 0);
    return {offset.dot(axis), offset.dot(other_axis)};
  };
  const Vec2 x = flat(point);
  const Vec2 b = flat(mesh.corner(i, 1));
  const Vec2 c = flat(mesh.corner(i, 2));
  const auto value = [&](int k) { return Eigen::RowVectorXd(corners.row(4 * i + k)); };
  if (mesh.n_corners(i) == 4) {
    const Vec2 st = quad_coordinates(Vec2::Zero(), b, c, flat(mesh.corner(i, 3)), x);
    return mix(mix(value(0), value(1), st[0]), mix(value(3), value(2), st[0]), st[1]);
  }
  const double whole = cross(b, c);
  const double at_b = std::clamp(cross(x, c) / whole, 0.0, 1.0);
  const double at_c = std::clamp(cross(b, x) / whole, 0.0, 1.0 - at_b);
  return value(0) + at_b * (value(1) - value(0)) + at_c * (value(2) - value(0));
}

/// What a camera sees. Holds all that the pixels share.
class CornerRenderer {
 public:
  CornerRenderer(const PatchMesh& mesh, const Visibility& visibility,
                 const Eigen::MatrixXd& patch_values, const Camera& camera,
                 const RenderOptions& options)
      : mesh_(mesh),
        corner_values_(corner_values(mesh, patch_values, options.crease_angle)),
        rays_(visibility, camera, options.width, options.height, options.samples) {}

  [[nodiscard]] Index n_bands() const { return corner_values_.cols(); }

  /// Fills one pixel of the picture.
  void draw_pixel(int x, int y, Image& image) const {
    Eigen::RowVectorXd mean = Eigen::RowVectorXd::Zero(n_bands());
    int n_hits = 0;
    for (int k = 0; k < rays_.n_samples(); ++k) {
      const auto seen = rays_.first_front(x, y, k);
      if (!seen) continue;
      ++n_hits;
      // A running mean of equal values is exactly that value, unlike their sum divided.
      mean += (interpolate(mesh_, corner_values_, seen->patch, seen->position) - mean) / n_hits;
    }
    const double coverage = static_cast<double>(n_hits) / rays_.n_samples();
    const Index pixel = static_cast<Index>(y) * image.width + x;
    image.values.row(pixel) = (coverage * mean).cast<float>();
    image.alpha[pixel] = static_cast<float>(coverage);
  }

 private:
  const PatchMesh& mesh_;
  Eigen::MatrixXd corner_values_;
  PrimaryRays rays_;
};

}  // namespace

Image blank_image(int width, int height, Index n_bands) {
  const Index n_pixels = Index{width} * height;
  return {.width = width,
          .height = height,
          .values = Eigen::MatrixXf::Zero(n_pixels, n_bands),
          .alpha = std::vector<float>(n_pixels)};
}

Image render(const PatchMesh& mesh, const Visibility& visibility, const Eigen::MatrixXd& radiosity,
             const Camera& camera, const RenderOptions& options) {
  return render_values(mesh, visibility, radiosity / kPi, camera, options);
}

Image render_values(const PatchMesh& mesh, const Visibility& visibility,
                    const Eigen::MatrixXd& patch_values, const Camera& camera,
                    const RenderOptions& options) {
  assert(options.width > 0 && options.height > 0 && options.samples > 0);
  const CornerRenderer renderer(mesh, visibility, patch_values, camera, options);
  Image image = blank_image(options.width, options.height, renderer.n_bands());
  RowCounter counter(options.progress, options.height);
  parallel_for(options.height, [&](std::ptrdiff_t y) {
    options.progress.check();
    for (int x = 0; x < options.width; ++x) renderer.draw_pixel(x, static_cast<int>(y), image);
    counter.add_rows(1);
  });
  return image;
}

Camera fit_camera(const PatchMesh& mesh) {
  Camera camera;
  camera.direction = Vec3(-0.5, -0.45, -1).normalized();
  return fit_camera(mesh, camera);
}

Camera fit_camera(const PatchMesh& mesh, const Camera& camera) {
  assert(mesh.size() > 0);
  constexpr double kMargin = 1.05;
  const Vec3 right = camera.direction.cross(camera.up).normalized();
  const Vec3 up = right.cross(camera.direction);
  const double slope = std::tan(camera.vertical_fov / 2) / kMargin;

  // A point at x across and z along the view is inside the pyramid of a camera at (c, -d) if
  // |x - c| <= slope (z + d); the outermost points on either side settle c and d.
  const Vec3 origin = bounds(mesh).center();
  Vec2 highest = Vec2::Constant(-std::numeric_limits<double>::infinity());  // of x - slope z
  Vec2 lowest = -highest;                                                   // of x + slope z
  for (Index i = 0; i < mesh.size(); ++i) {
    for (int k = 0; k < mesh.n_corners(i); ++k) {
      const Vec3 offset = mesh.corner(i, k) - origin;
      const Vec2 across(offset.dot(right), offset.dot(up));
      const Vec2 depth = Vec2::Constant(slope * offset.dot(camera.direction));
      highest = highest.cwiseMax(across - depth);
      lowest = lowest.cwiseMin(across + depth);
    }
  }
  const Vec2 center = (highest + lowest) / 2;
  const double distance = (highest - lowest).maxCoeff() / (2 * slope);
  Camera fitted = camera;
  fitted.position = origin + center[0] * right + center[1] * up - distance * camera.direction;
  return fitted;
}

}  // namespace radiosity
