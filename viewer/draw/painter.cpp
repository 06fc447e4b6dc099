#include "viewer/draw/painter.h"

#include <utility>

#include "viewer/desk/painting.h"
#include "viewer/desk/pinning.h"

namespace viewer {
namespace {

bool is_large(const Desk& desk) {
  return desk.session.is_open() && desk.session.model().mesh->size() > kMostDrawn;
}

}  // namespace

void Painter::paint(Desk& desk, SceneView& view) {
  const bool is_new = desk.session.model().mesh != mesh_;
  if (is_new) {
    mesh_ = desk.session.model().mesh;
    points_.reset();
    painted_.reset();
    desk.is_exposure_due = true;
    desk.legend.reset();
    large_.clear();
    if (mesh_ && !is_large(desk)) take_patches(desk, view);
  }
  view.set_camera(picture_camera(desk));
  view.set_edges(desk.look.edges);
  view.set_backs_hidden(desk.look.hide_backs);
  if (is_large(desk)) {
    large_.paint(desk, view);
    return;
  }
  desk.is_painting_due = false;
  if (!points_ || (painted_ && !painted_->is_stale(desk))) return;
  paint_colors(desk, view);
}

bool Painter::is_done(const Desk& desk) const {
  return desk.session.model().mesh == mesh_ && (!is_large(desk) || large_.is_done(desk));
}

void Painter::take_patches(Desk& desk, SceneView& view) {
  points_ = std::make_unique<PatchPoints>(mesh_);
  view.set_triangles({points_->positions(), points_->triangles(), points_->has_back()}, mesh_);
  desk.is_exposure_due = true;
}

void Painter::paint_colors(Desk& desk, SceneView& view) {
  PaintingTask task{.known = desk.session.known(),
                    .look = desk.look,
                    .up = desk.up,
                    .subtracted = subtracted_light(desk)};
  // While light is spreading it gets brighter: the exposure follows until it is known, and then
  // stays, so that lamps that are dimmed look dimmed.
  if (!desk.is_exposure_due && !was_spreading_) task.exposure = desk.exposure;
  Painting painting = make_painting(task);
  if (painting.is_light) {
    desk.exposure = painting.exposure;
    desk.is_exposure_due = false;
    was_spreading_ = painting.is_spreading;
  }
  const Eigen::MatrixXd values = points_->values(painting.values, painting.is_smooth);
  if (painting.legend) {
    view.set_map_positions(map_positions(painting, values), painting.legend->map);
  } else {
    view.set_colors(point_colors(painting, values));
  }
  painted_ = {desk.session.versions(), desk.look, painting.is_light, task.subtracted};
  desk.legend = std::move(painting.legend);
}

}  // namespace viewer
