#include "viewer/draw/plane_painter.h"

#include <utility>

#include "viewer/desk/grids.h"
#include "viewer/desk/measuring.h"
#include "viewer/draw/painted_state.h"

namespace viewer {
namespace {

/// What the plane that is shown was made of; null if none is.
std::shared_ptr<const void> plane_source(const Desk& desk) {
  if (desk.look.show == Show::grid && shown_plane(desk).grid != nullptr) {
    return desk.plan.readings();
  }
  const Readings* readings = desk.meter.readings();
  const bool is_plane_shown =
      desk.look.show == Show::work_plane && readings != nullptr && readings->plane;
  return is_plane_shown ? desk.meter.shared_readings() : nullptr;
}

PlanePicture picture_of(const Desk& desk, const std::string& note) {
  if (const auto grid = shown_grid(desk)) {
    return plane_picture(grid->measured, grid->values,
                         {.unit = grid->unit, .note = note, .title = grid->title}, desk.look);
  }
  const radiosity::MeasuredGrid& plane = *desk.meter.readings()->plane;
  return plane_picture(plane, measured_values(desk.session, plane.irradiance),
                       {.unit = measured_unit(desk.session), .note = note}, desk.look);
}

}  // namespace

void PlanePainter::paint(Desk& desk, SceneView& view) {
  const std::shared_ptr<const void> source = plane_source(desk);
  if (source == nullptr) {
    painted_.reset();
    view.set_inner_surface({});
    return;
  }
  // Not how far it is, which would have it painted all the time.
  const bool is_current = desk.look.show == Show::grid ? desk.plan.is_current(desk.session)
                                                       : desk.meter.is_current(desk.session);
  const std::string note = is_current ? "" : "not of the light of now";
  const bool is_stale = !painted_ || painted_->source != source || painted_->note != note ||
                        !is_same_look(painted_->look, desk.look);
  if (is_stale) {
    PlanePicture picture = picture_of(desk, note);
    legend_ = std::move(picture.legend);
    numbers_ = std::move(picture.numbers);
    view.set_inner_surface({.points = std::move(picture.points),
                            .triangles = std::move(picture.triangles),
                            .positions = std::move(picture.positions),
                            .map = legend_.map,
                            .lines = std::move(picture.lines)});
    painted_ = {.source = source, .look = desk.look, .note = note};
  }
  // The patches' painter has none of its own now.
  desk.legend = legend_;
  desk.iso_numbers = numbers_;
}

}  // namespace viewer
