#pragma once

#include <Eigen/Core>
#include <vector>

#include "radiosity/base/geometry.h"
#include "radiosity/base/progress.h"
#include "radiosity/scene/corner_values.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/scene/patch_texture.h"
#include "radiosity/scene/scene.h"
#include "radiosity/visibility/visibility.h"

namespace radiosity {

/// A picture: one linear value per pixel and band, row-major from the top left.
struct Image {
  int width = 0;
  int height = 0;
  Eigen::MatrixXf values;    ///< (width * height) x n_bands, linear
  std::vector<float> alpha;  ///< coverage in [0, 1] per pixel: 0 where nothing was hit
};

/// A picture in which nothing was hit.
Image blank_image(int width, int height, Index n_bands);

struct RenderOptions {
  int width = 512;             ///< pixels
  int height = 512;            ///< pixels
  int samples = 16;            ///< primary rays per pixel, for antialiasing; a square number
  double crease_angle = 0.35;  ///< radian; patches whose normals differ by more are not smoothed
  Progress progress = {};      ///< stage "picture", in rows
};

/// Radiance π⁻¹ B seen by the camera, W/(m² sr) per band: the mean over the samples of a pixel of
/// `corner_values` interpolated within the patch (bilinear in quads, barycentric in triangles), 0
/// where a sample meets nothing. `radiosity` is n_patches x n_bands. The backs of one-sided
/// surfaces are not drawn (one looks through them into the scene). Same input, same picture, at
/// any number of threads. Throws Interrupted if asked to stop.
Image render(const PatchMesh& mesh, const Visibility& visibility, const Eigen::MatrixXd& radiosity,
             const Camera& camera, const RenderOptions& options = {});

/// The same of patches with textures: M_e + ρ(x) H(x), with the irradiance H interpolated likewise.
/// `exitance` and `irradiance` are n_patches x n_bands, W/m².
Image render_textured(const PatchMesh& mesh, const Visibility& visibility,
                      const Eigen::MatrixXd& radiosity, const Eigen::MatrixXd& exitance,
                      const Eigen::MatrixXd& irradiance, const TextureMap& textures,
                      const Camera& camera, const RenderOptions& options = {});

/// The same picture of any quantity: `patch_values` (n_patches x n) as they are, in their unit.
Image render_values(const PatchMesh& mesh, const Visibility& visibility,
                    const Eigen::MatrixXd& patch_values, const Camera& camera,
                    const RenderOptions& options = {});

/// The camera moved back or forth and aside until it sees the whole scene from outside in its
/// direction: pictures at least as wide as high hold everything. Needs a patch.
Camera fit_camera(const PatchMesh& mesh, const Camera& camera);

/// A camera that sees the whole scene from outside, from the right and above, for scenes without
/// one; y is up. Needs a patch.
Camera fit_camera(const PatchMesh& mesh);

}  // namespace radiosity
