#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "radiosity/base/geometry.h"
#include "radiosity/picture/measured_grid.h"
#include "radiosity/picture/point_grid.h"
#include "viewer/desk/desk.h"

namespace viewer {

/// Measures a work plane from now on and shows it. Throws SceneError if it does not fit into the
/// scene, or if there is none.
void show_work_plane(Desk& desk, const radiosity::WorkPlaneOptions& options);
/// Measures none any more.
void hide_work_plane(Desk& desk);

/// The points of the plane that is drawn, work plane or grid; null if none is.
struct ShownPlane {
  const radiosity::PointGrid* grid = nullptr;
  const std::vector<radiosity::PointPlace>* places = nullptr;
};
ShownPlane shown_plane(const Desk& desk);

/// Where a ray from `origin` in `direction` (unit) meets a cell of the work plane that is drawn.
struct PlaneHit {
  double distance = 0;          ///< m
  radiosity::Index point = -1;  ///< of the cell
};
/// Empty if it meets none, or none is shown.
std::optional<PlaneHit> plane_hit(const Desk& desk, const radiosity::Vec3& origin,
                                  const radiosity::Vec3& direction);
/// The reading of the cell that is seen at a place of the picture, x and y in [0, 1] from its top
/// left; empty if that shows something else.
std::optional<double> plane_value_at(const Desk& desk, double x, double y);

/// Measures at the surface, or in the work plane, that is seen at a place of the picture. Whether
/// there is any.
bool add_meter_at(Desk& desk, double x, double y);
/// Measures what arrives at a point anywhere from the side that `normal` (any length but 0) tells.
/// Throws SceneError if no scene is open, std::invalid_argument for such a normal.
void add_meter(Desk& desk, const radiosity::Vec3& position, const radiosity::Vec3& normal);

/// A mouse holds one of the two, or none: clicks lay the tape, or they add to the light meter.
void take_tape(Desk& desk, bool is_taken);
void take_meter(Desk& desk, bool is_taken);

/// Irradiance (W/m² per band, a row for each point) in one number: lux or, in thermal scenes, W/m².
Eigen::VectorXd measured_values(const Session& session, const Eigen::MatrixXd& irradiance);
const char* measured_unit(const Session& session);
/// Of point k of the light meter; empty until it is measured.
std::optional<double> meter_value(const Desk& desk, std::size_t point);
/// Of the work plane; empty until it is measured.
std::optional<radiosity::GridSummary> plane_summary(const Desk& desk);
/// Whether anything is being measured in the background.
bool is_measuring(const Desk& desk);
/// What keeps readings from being those of the scene as it is: "being measured"; "" if they are.
std::string readings_note(const Desk& desk);

/// Writes all readings as .csv. Throws OutputError, also if there are none, or if they are not of
/// the scene as it is now.
void save_readings(const Desk& desk, const std::string& path);

}  // namespace viewer
