#pragma once

#include <memory>
#include <optional>

#include "radiosity/scene/patch_mesh.h"
#include "viewer/desk/desk.h"
#include "viewer/desk/patch_points.h"
#include "viewer/draw/large_painter.h"
#include "viewer/draw/painted_state.h"
#include "viewer/draw/scene_view.h"

namespace viewer {

/// Keeps the drawing in step with the desk: patches, colours, camera, legend.
class Painter {
 public:
  /// Brings `view` up to date, and the desk's legend and automatic exposure; cheap if nothing has
  /// changed. Of very many patches, as LargePainter does.
  void paint(Desk& desk, SceneView& view);
  /// Takes in what the background has painted. Whether there was something.
  bool update() { return large_.update(); }
  /// Whether something is being painted.
  [[nodiscard]] bool is_busy() const { return large_.is_busy(); }
  /// Whether all is painted as the desk has it now.
  [[nodiscard]] bool is_done(const Desk& desk) const;
  /// Whether smooth edges of what VTK draws are of use: few patches, not what stands for many.
  [[nodiscard]] bool is_exact() const { return points_ != nullptr; }
  /// A picture to be drawn over the scene, or null.
  [[nodiscard]] const std::shared_ptr<const io::RgbPicture>& still() const {
    return large_.still();
  }

 private:
  void take_patches(Desk& desk, SceneView& view);
  void take_hidden(const Desk& desk, SceneView& view);
  void paint_colors(Desk& desk, SceneView& view);
  void paint_lines(const Desk& desk, SceneView& view);

  std::shared_ptr<const radiosity::PatchMesh> mesh_;
  std::unique_ptr<PatchPoints> points_;
  HiddenSurfaces hidden_;  // as it is drawn
  std::vector<SurfaceLine> outlines_;
  std::vector<SurfaceLine> isolines_;
  bool has_outlines_ = false;  // among the lines that are drawn
  std::optional<PaintedState> painted_;
  bool was_spreading_ = false;  // the light that was painted last was a preview
  LargePainter large_;
};

}  // namespace viewer
