#include "radiosity/picture/render.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>
#include <limits>

#include "radiosity/base/parallel.h"
#include "radiosity/picture/patch_interpolation.h"
#include "radiosity/picture/primary_rays.h"

namespace radiosity {
namespace {

using Vec2 = Eigen::Vector2d;

/// A value for any place on a patch, in as many bands.
struct PatchValues {
  Index n_bands;
  std::function<Eigen::RowVectorXd(const SurfacePoint&)> at;
};

/// Fills one pixel of the picture.
void draw_pixel(const PatchMesh& mesh, const PrimaryRays& rays, const PatchValues& values, int x,
                int y, Image& image) {
  Eigen::RowVectorXd mean = Eigen::RowVectorXd::Zero(values.n_bands);
  int n_hits = 0;
  for (int k = 0; k < rays.n_samples(); ++k) {
    const auto seen = rays.first_front(x, y, k);
    if (!seen) continue;
    ++n_hits;
    // A running mean of equal values is exactly that value, unlike their sum divided.
    mean += (values.at(in_part(mesh, *seen)) - mean) / n_hits;
  }
  const double coverage = static_cast<double>(n_hits) / rays.n_samples();
  const Index pixel = static_cast<Index>(y) * image.width + x;
  image.values.row(pixel) = (coverage * mean).cast<float>();
  image.alpha[pixel] = static_cast<float>(coverage);
}

Image render_points(const PatchMesh& mesh, const Visibility& visibility, const PatchValues& values,
                    const Camera& camera, const RenderOptions& options) {
  assert(options.width > 0 && options.height > 0 && options.samples > 0);
  const PrimaryRays rays(visibility, camera, options.width, options.height, options.samples);
  Image image = blank_image(options.width, options.height, values.n_bands);
  RowCounter counter(options.progress, options.height);
  parallel_for(options.height, [&](std::ptrdiff_t y) {
    options.progress.check();
    for (int x = 0; x < options.width; ++x) {
      draw_pixel(mesh, rays, values, x, static_cast<int>(y), image);
    }
    counter.add_rows(1);
  });
  return image;
}

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

Image render_textured(const PatchMesh& mesh, const Visibility& visibility,
                      const Eigen::MatrixXd& radiosity, const Eigen::MatrixXd& exitance,
                      const Eigen::MatrixXd& irradiance, const TextureMap& textures,
                      const Camera& camera, const RenderOptions& options) {
  const Eigen::MatrixXd radiance = corner_values(mesh, radiosity / kPi, options.crease_angle);
  const Eigen::MatrixXd received = corner_values(mesh, irradiance / kPi, options.crease_angle);
  const auto at = [&](const SurfacePoint& point) -> Eigen::RowVectorXd {
    const auto texel = textures.at(point.patch, point.position);
    if (!texel) return interpolate(mesh, radiance, point.patch, point.position);
    return exitance.row(point.patch) / kPi +
           interpolate(mesh, received, point.patch, point.position)
               .cwiseProduct(texel->matrix().transpose());
  };
  return render_points(mesh, visibility, {radiance.cols(), at}, camera, options);
}

Image render_values(const PatchMesh& mesh, const Visibility& visibility,
                    const Eigen::MatrixXd& patch_values, const Camera& camera,
                    const RenderOptions& options) {
  const Eigen::MatrixXd corners = corner_values(mesh, patch_values, options.crease_angle);
  const auto at = [&](const SurfacePoint& point) {
    return interpolate(mesh, corners, point.patch, point.position);
  };
  return render_points(mesh, visibility, {corners.cols(), at}, camera, options);
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
