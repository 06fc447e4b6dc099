#pragma once

#include <Eigen/Core>
#include <vector>

#include "radiosity/patch_mesh.h"
#include "radiosity/progress.h"
#include "radiosity/scene.h"
#include "radiosity/visibility.h"

namespace radiosity {

/// A picture: one linear value per pixel and band, row-major from the top left.
struct Image {
  int width = 0;
  int height = 0;
  Eigen::MatrixXf values;    ///< (width * height) x n_bands, linear
  std::vector<float> alpha;  ///< coverage in [0, 1] per pixel: 0 where nothing was hit
};

struct RenderOptions {
  int width = 512;             ///< pixels
  int height = 512;            ///< pixels
  int samples = 16;            ///< primary rays per pixel, a square number, for antialiasing
  double crease_angle = 0.35;  ///< radian; patches whose normals differ by more are not smoothed
  Progress progress{};
};

/// Radiosity at the corners of each patch, for smooth display: row 4 i + k is corner k of patch i
/// (the fourth row of a triangle repeats its third), n_bands columns, W/m². Values are averaged
/// over the patches that meet at a corner, lie on the same surface and bend by less than the crease
/// angle; a corner that lies on another patch's edge (T-vertex) takes that edge's value, so that
/// no crack shows.
Eigen::MatrixXd corner_values(const PatchMesh& mesh, const Eigen::MatrixXd& patch_values,
                              double crease_angle = 0.35);

/// Radiance π⁻¹ B seen by the camera, interpolated between patches. The backs of one-sided
/// surfaces are not drawn (one looks through them into the scene).
Image render(const PatchMesh& mesh, const Visibility& visibility, const Eigen::MatrixXd& radiosity,
             const Camera& camera, const RenderOptions& options = {});

/// A camera that sees the whole scene, for scenes without one.
Camera fit_camera(const PatchMesh& mesh);

}  // namespace radiosity
