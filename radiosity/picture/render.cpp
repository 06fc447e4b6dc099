#include "radiosity/picture/render.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "radiosity/base/parallel.h"
#include "radiosity/picture/patch_interpolation.h"
#include "radiosity/picture/primary_rays.h"

namespace radiosity {
namespace {

using Vec2 = Eigen::Vector2d;

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
      const SurfacePoint point = in_part(mesh_, *seen);
      mean += (interpolate(mesh_, corner_values_, point.patch, point.position) - mean) / n_hits;
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
