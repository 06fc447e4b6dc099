#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "io/picture/map_color.h"
#include "io/picture/rgb_picture.h"
#include "radiosity/base/geometry.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/scene/scene.h"
#include "viewer/desk/hidden_surfaces.h"
#include "viewer/desk/region.h"
#include "viewer/desk/surface_line.h"

class vtkRenderer;

namespace viewer {

/// Triangles to be drawn, counter-clockwise seen from the front.
struct Triangles {
  std::span<const radiosity::Vec3> positions = {};              ///< of the points, m
  std::span<const std::array<std::int32_t, 3>> triangles = {};  ///< their points
  std::span<const std::uint8_t> has_back = {};  ///< per triangle: whether its back may be shown
  std::span<const std::int32_t> surfaces = {};  ///< per triangle
  HiddenSurfaces hidden = {};                   ///< of which none is drawn
};

/// A surface that is drawn within the scene, seen from both sides.
struct InnerSurface {
  std::vector<radiosity::Vec3> points;                 ///< m
  std::vector<std::array<std::int32_t, 3>> triangles;  ///< their points
  std::vector<float> positions;                        ///< per point, on the colour map
  io::ColorMap map = io::ColorMap::viridis;
  std::vector<SurfaceLine> lines;
};

/// A part of a picture's width, in shares of it.
struct Columns {
  double left = 0;
  double right = 1;
  friend bool operator==(const Columns&, const Columns&) = default;
};

/// The patches as VTK draws them. Notes itself whether a new drawing would differ from the last.
class SceneView {
 public:
  SceneView();
  ~SceneView();
  SceneView(const SceneView&) = delete;
  SceneView& operator=(const SceneView&) = delete;

  /// Draws these from now on, grey until they get colours; `edges`, if any, are those of a mesh.
  void set_triangles(const Triangles& triangles, std::shared_ptr<const radiosity::PatchMesh> edges);
  /// 8-bit sRGB per point.
  void set_colors(const std::vector<io::Rgb>& colors);
  /// Positions on the colour map, in [0, 1], per point; negative: nothing is known, grey.
  void set_map_positions(std::span<const float> positions);
  /// The colour map that these are positions on; viridis at first.
  void set_color_map(io::ColorMap map);
  /// Lines over the surfaces, as far as the camera sees them (`is_drawn`).
  void set_lines(std::vector<SurfaceLine> lines);
  /// A surface of its own colours beside the patches; without triangles there is none.
  void set_inner_surface(InnerSurface surface);
  /// Of edges and lines, pixels; 1 at first.
  void set_line_width(float width);
  void set_edges(bool are_shown);
  void set_backs_hidden(bool are_hidden);
  void set_camera(const radiosity::Camera& camera);
  /// Where the scene is seen, in a window of this size, and which part of that is drawn.
  void set_region(const Region& region, int window_width, int window_height,
                  const Columns& columns = {});

  [[nodiscard]] vtkRenderer& renderer();
  [[nodiscard]] bool is_dirty() const { return is_dirty_; }
  /// To be called when it has been drawn.
  void set_drawn() { is_dirty_ = false; }

 private:
  void update_camera();
  void update_inner_surface();
  void update_edges();
  void update_lines();

  struct Parts;
  std::unique_ptr<Parts> parts_;
  bool is_dirty_ = true;
};

}  // namespace viewer
