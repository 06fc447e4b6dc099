#include "viewer/draw/plane_painter.h"

#include <utility>

#include "viewer/desk/measuring.h"
#include "viewer/draw/painted_state.h"

namespace viewer {

void PlanePainter::paint(Desk& desk, SceneView& view) {
  const Readings* readings = desk.meter.readings();
  const bool is_shown =
      desk.look.show == Show::work_plane && readings != nullptr && readings->plane;
  if (!is_shown) {
    painted_.reset();
    view.set_inner_surface({});
    return;
  }
  // Not how far it is, which would have it painted all the time.
  const std::string note = desk.meter.is_current(desk.session) ? "" : "not of the light of now";
  const bool is_stale = !painted_ || painted_->readings.get() != readings ||
                        painted_->note != note || !is_same_look(painted_->look, desk.look);
  if (is_stale) {
    PlanePicture picture =
        plane_picture(*readings->plane, measured_values(desk.session, readings->plane->irradiance),
                      measured_unit(desk.session), desk.look, note);
    legend_ = std::move(picture.legend);
    numbers_ = std::move(picture.numbers);
    view.set_inner_surface({.points = std::move(picture.points),
                            .triangles = std::move(picture.triangles),
                            .positions = std::move(picture.positions),
                            .map = legend_.map,
                            .lines = std::move(picture.lines)});
    painted_ = {.readings = desk.meter.shared_readings(), .look = desk.look, .note = note};
  }
  // The patches' painter has none of its own now.
  desk.legend = legend_;
  desk.iso_numbers = numbers_;
}

}  // namespace viewer
