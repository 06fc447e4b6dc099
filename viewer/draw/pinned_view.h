#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "radiosity/scene/patch_mesh.h"
#include "viewer/desk/desk.h"
#include "viewer/desk/patch_points.h"
#include "viewer/draw/scene_view.h"

namespace viewer {

/// Draws pinned light as what is shown now is drawn: on its scale, with its exposure.
class PinnedView {
 public:
  /// Brings it in step with the desk, whose legend and exposure are up to date. Null if no pinned
  /// light is shown beside that of now.
  SceneView* paint(const Desk& desk);

 private:
  /// What the colours depend on.
  struct Painted {
    std::shared_ptr<const Pinned> pinned;
    Look look;
    double exposure = 1;
  };
  void paint_colors(const Desk& desk, const Look& look);

  SceneView view_;
  std::shared_ptr<const radiosity::PatchMesh> mesh_;
  std::unique_ptr<PatchPoints> points_;
  HiddenSurfaces hidden_;
  std::vector<SurfaceLine> outlines_;
  std::optional<Painted> painted_;
};

}  // namespace viewer
