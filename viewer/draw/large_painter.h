#pragma once

#include <chrono>
#include <memory>
#include <optional>

#include "io/picture/rgb_picture.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/scene/scene.h"
#include "viewer/desk/coarse_mesh.h"
#include "viewer/desk/desk.h"
#include "viewer/desk/painting.h"
#include "viewer/desk/ray_picture.h"
#include "viewer/draw/painted_state.h"
#include "viewer/draw/scene_view.h"
#include "viewer/work/worker.h"

namespace viewer {

/// Beyond so many patches, a frame of all of them would take too long.
inline constexpr radiosity::Index kMostDrawn = 30'000;

/// Keeps the drawing of very many patches in step with the desk: few triangles that can be drawn in
/// each frame and, once nothing moves, a picture by rays. What takes longer than a frame is done in
/// the background, so that colours follow the desk a little later. Of one thread.
class LargePainter {
 public:
  /// Begins what is due and shows what has been done.
  void paint(Desk& desk, SceneView& view);
  /// Gives up the patches.
  void clear();

  /// Takes in what the background has done. Whether there was something.
  bool update();
  /// Whether something is being done.
  [[nodiscard]] bool is_busy() const;
  /// Whether the picture is there, of what the desk has now and at its best.
  [[nodiscard]] bool is_done(const Desk& desk) const;
  /// What the camera sees, to be drawn over the scene; null while it moves.
  [[nodiscard]] const std::shared_ptr<const io::RgbPicture>& still() const { return still_; }

 private:
  using Clock = std::chrono::steady_clock;
  struct Prepared;  // what depends on the patches alone
  struct Colored {
    PaintedState state;
    Painting painting;
    CornerColors corners;
    CornerColors points;  // of the coarse mesh
    Isolines isolines;    // likewise
    /// Of what `state` does not hide; null if none were wanted.
    std::shared_ptr<const std::vector<SurfaceLine>> outlines;
  };
  /// What a picture is of.
  struct Frame {
    radiosity::Camera camera;
    int width = 0;
    int height = 0;
    bool hides_backs = true;
    bool has_edges = false;
    bool has_outlines = false;
    HiddenSurfaces hidden;
    bool operator==(const Frame& other) const;
  };
  [[nodiscard]] static Frame frame_of(const Desk& desk);
  void prepare(const Desk& desk);
  void start_colors(Desk& desk);
  void take_colors(Desk& desk, SceneView& view);
  [[nodiscard]] bool is_due(const Desk& desk) const;
  void take_triangles(const Desk& desk, SceneView& view);
  void paint_lines(const Desk& desk, SceneView& view);
  void paint_still(const Desk& desk);

  std::shared_ptr<const radiosity::PatchMesh> mesh_;
  std::shared_ptr<const Prepared> prepared_;
  bool is_view_set_ = false;
  PaintedState started_;      // the latest colouring
  bool is_shooting_ = false;  // it was of light that is being shot
  Clock::time_point begun_;
  Clock::time_point rest_until_;
  std::shared_ptr<const Colored> colored_;       // the latest that is done
  bool is_color_new_ = false;                    // and not shown yet
  bool are_lines_due_ = false;                   // its isolines are not drawn yet
  bool has_outlines_ = false;                    // among the lines that are drawn
  HiddenSurfaces hidden_;                        // as it is drawn
  Frame frame_;                                  // of the latest drawing
  std::shared_ptr<const Colored> still_colors_;  // of the picture that is made, or there
  std::shared_ptr<const io::RgbPicture> still_;
  std::shared_ptr<const Colored> shown_;  // colours of what is seen
  bool is_still_best_ = false;
  // Last, so that they end first.
  Worker coloring_;
  Worker picturing_;
};

}  // namespace viewer
