#pragma once

#include <memory>
#include <optional>

#include "radiosity/scene/patch_mesh.h"
#include "radiosity/scene/scene.h"
#include "viewer/desk/desk.h"
#include "viewer/desk/patch_points.h"
#include "viewer/draw/scene_view.h"

namespace viewer {

/// Keeps the drawing in step with the desk: patches, colours, camera, legend.
class Painter {
 public:
  /// Brings `view` up to date, and the desk's legend and automatic exposure; cheap if nothing has
  /// changed.
  void paint(Desk& desk, SceneView& view);

 private:
  void take_patches(Desk& desk, SceneView& view);
  void paint_colors(Desk& desk, SceneView& view);
  void paint_light(Desk& desk, SceneView& view, const Eigen::MatrixXd& radiosity);
  void paint_field(Desk& desk, SceneView& view, const ShownField& field);
  void paint_unlit(const Desk& desk, SceneView& view);

  std::shared_ptr<const radiosity::PatchMesh> mesh_;
  std::unique_ptr<PatchPoints> points_;
  Session::Versions painted_;
  Look look_;
  bool was_spreading_ = false;  // the light that was painted last was a preview
  bool has_painted_ = false;
};

/// Linear sRGB of patches' values in any bands, n x 3.
Eigen::MatrixX3f display_colors(const Eigen::MatrixXd& values, const radiosity::Bands& bands);
/// Linear sRGB in [0, 1] of surfaces of that reflectance (n x b) in a light in which one that
/// reflects all is white, n x 3.
Eigen::MatrixX3f surface_colors(const Eigen::MatrixXd& reflectance, const radiosity::Bands& bands);

}  // namespace viewer
