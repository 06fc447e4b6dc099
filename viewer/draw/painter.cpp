#include "viewer/draw/painter.h"

#include <algorithm>
#include <utility>

#include "viewer/desk/outlines.h"
#include "viewer/desk/painting.h"
#include "viewer/desk/pinning.h"

namespace viewer {
namespace {

bool is_large(const Desk& desk) {
  return desk.session.is_open() && desk.session.model().mesh->size() > kMostDrawn;
}

/// Of what is shown in false colours; the light itself shows shapes.
bool wants_outlines(const Desk& desk) {
  return desk.legend && desk.look.outlines && !is_plane(desk.look.show);
}

double size_of(const Desk& desk) { return desk.session.model().bounds.diagonal().norm(); }

}  // namespace

void Painter::paint(Desk& desk, SceneView& view) {
  const bool is_new = desk.session.model().mesh != mesh_;
  if (is_new) {
    mesh_ = desk.session.model().mesh;
    points_.reset();
    painted_.reset();
    desk.is_exposure_due = true;
    desk.legend.reset();
    desk.iso_numbers.clear();
    large_.clear();
    if (mesh_ && !is_large(desk)) take_patches(desk, view);
  }
  view.set_camera(picture_camera(desk));
  view.set_edges(desk.look.edges);
  view.set_line_width(static_cast<float>(std::max(1.0, desk.scale)));
  view.set_backs_hidden(desk.look.hide_backs);
  if (is_large(desk)) {
    large_.paint(desk, view);
    return;
  }
  desk.is_painting_due = false;
  if (!points_) return;
  const bool is_stale = !painted_ || painted_->is_stale(desk);
  if (!(hidden_ == desk.look.hidden)) take_hidden(desk, view);
  if (is_stale) paint_colors(desk, view);
  if (is_stale || has_outlines_ != wants_outlines(desk)) paint_lines(desk, view);
}

bool Painter::is_done(const Desk& desk) const {
  return desk.session.model().mesh == mesh_ && (!is_large(desk) || large_.is_done(desk));
}

void Painter::take_patches(Desk& desk, SceneView& view) {
  points_ = std::make_unique<PatchPoints>(mesh_);
  desk.is_exposure_due = true;
  take_hidden(desk, view);
}

/// The patches that are not hidden, without colours.
void Painter::take_hidden(const Desk& desk, SceneView& view) {
  hidden_ = desk.look.hidden;
  view.set_triangles({points_->positions(), points_->triangles(), points_->has_back(),
                      points_->surfaces(), hidden_},
                     mesh_);
  outlines_ = make_outlines(*mesh_, hidden_);
  isolines_.clear();
}

void Painter::paint_lines(const Desk& desk, SceneView& view) {
  has_outlines_ = wants_outlines(desk);
  std::vector<SurfaceLine> lines = isolines_;
  if (has_outlines_) lines.insert(lines.end(), outlines_.begin(), outlines_.end());
  view.set_lines(std::move(lines));
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
  isolines_.clear();
  desk.iso_numbers.clear();
  if (painting.legend) {
    const std::vector<float> positions = map_positions(painting, values);
    view.set_color_map(painting.legend->map);
    view.set_map_positions(positions);
    Isolines isolines = painted_isolines(
        painting, {points_->positions(), points_->triangles(), points_->surfaces(), positions},
        wanted_levels(painting, desk.look), desk.look.hidden, size_of(desk));
    isolines_ = std::move(isolines.lines);
    desk.iso_numbers = std::move(isolines.numbers);
  } else {
    view.set_colors(point_colors(painting, values));
  }
  painted_ = {desk.session.versions(), desk.look, painting.is_light, task.subtracted};
  desk.legend = std::move(painting.legend);
}

}  // namespace viewer
