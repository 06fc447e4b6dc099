#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "radiosity/base/geometry.h"
#include "radiosity/scene/patch_mesh.h"
#include "viewer/desk/back_outlines.h"
#include "viewer/desk/desk.h"

namespace viewer {

/// Draws over the picture what tells where one is: outlines of faces whose backs are not drawn.
/// Needs an ImGui frame.
class Guides {
 public:
  /// `scale` is the size of text relative to a plain screen.
  void draw(const Desk& desk, double scale);

 private:
  void draw_outlines(const Desk& desk, float scale);

  std::shared_ptr<const radiosity::PatchMesh> mesh_;
  std::unique_ptr<BackOutlines> outlines_;  // of the mesh
  std::optional<radiosity::Vec3> eye_;      // for which the pieces were found
  std::vector<OutlinePiece> pieces_;
};

/// Draws the axes in a corner, where they have room. Likewise.
void draw_axes(const Desk& desk, double scale);

}  // namespace viewer
