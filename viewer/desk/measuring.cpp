#include "viewer/desk/measuring.h"

#include <fmt/format.h>

#include <stdexcept>
#include <vector>

#include "io/base/extension.h"
#include "io/result/readings_csv.h"
#include "radiosity/base/error.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/solve/quantity.h"
#include "viewer/desk/grids.h"
#include "viewer/desk/picking.h"

namespace viewer {

using radiosity::Index;
using radiosity::Vec3;

namespace {

void check_scene(const Desk& desk) {
  if (!desk.session.is_open()) throw radiosity::SceneError("there is no scene to measure in");
}

/// The cell of the plane that is seen at a place of the picture, nothing being before it.
std::optional<PlaneHit> seen_plane(const Desk& desk, double x, double y) {
  if (desk.region.height <= 0) return std::nullopt;
  const radiosity::Camera camera = picture_camera(desk);
  const double aspect = static_cast<double>(desk.region.width) / desk.region.height;
  const auto found = plane_hit(desk, camera.position, ray_direction(camera, x, y, aspect));
  if (!found) return std::nullopt;
  const auto hit = hit_at(desk, x, y);
  return hit && hit->distance < found->distance ? std::nullopt : found;
}

/// All that was measured, the plane's points first.
std::vector<io::Reading> all_readings(const Readings& readings) {
  std::vector<io::Reading> all;
  if (readings.plane) {
    const radiosity::PointGrid& grid = readings.plane->grid;
    for (Index k = 0; k < grid.size(); ++k) {
      all.push_back(
          {.name = fmt::format("plane {} {}", k / grid.n_columns + 1, k % grid.n_columns + 1),
           .surface = "",
           .position = grid.point(k),
           .normal = grid.normal(),
           .place = readings.plane->places[static_cast<std::size_t>(k)],
           .irradiance = readings.plane->irradiance.row(k)});
    }
  }
  for (std::size_t k = 0; k < readings.task.points.size(); ++k) {
    const MeterPoint& point = readings.task.points[k];
    all.push_back({.name = fmt::format("point {}", k + 1),
                   .surface = point.surface,
                   .position = point.position,
                   .normal = point.normal,
                   .irradiance = readings.points.row(static_cast<Index>(k))});
  }
  return all;
}

}  // namespace

ShownPlane shown_plane(const Desk& desk) {
  if (desk.look.show == Show::work_plane) {
    const Readings* readings = desk.meter.readings();
    if (readings == nullptr || !readings->plane) return {};
    return {&readings->plane->grid, &readings->plane->places};
  }
  const auto readings = desk.plan.readings();
  const std::size_t g = desk.look.grid.grid;
  const bool is_shown =
      desk.look.show == Show::grid && readings && g < readings->measured.grids.size();
  if (!is_shown) return {};
  const radiosity::GridLight& light = readings->measured.grids[g].light;
  if (!light.where.grid) return {};
  return {&*light.where.grid, &light.places};
}

void show_work_plane(Desk& desk, const radiosity::WorkPlaneOptions& options) {
  check_scene(desk);
  make_work_plane(*desk.session.model().mesh, up_direction(desk.up), options);  // to refuse it
  desk.meter.set_plane(options);
  if (desk.look.show == Show::work_plane) return;
  show(desk, "work-plane");
  desk.look.isolines = true;
}

void hide_work_plane(Desk& desk) {
  desk.meter.set_plane({});
  if (desk.look.show == Show::work_plane) show(desk, first_quantity(desk.domain));
}

std::optional<PlaneHit> plane_hit(const Desk& desk, const Vec3& origin, const Vec3& direction) {
  const ShownPlane plane = shown_plane(desk);
  if (plane.grid == nullptr) return std::nullopt;
  const radiosity::PointGrid& grid = *plane.grid;
  const Vec3 normal = grid.normal();
  const double distance = normal.dot(grid.corner - origin) / normal.dot(direction);
  if (!(distance > 0)) return std::nullopt;
  const Vec3 place = origin + distance * direction - grid.corner;
  const double column = place.dot(grid.column) / grid.column.squaredNorm();
  const double row = place.dot(grid.row) / grid.row.squaredNorm();
  const bool is_within = column >= 0 && column < static_cast<double>(grid.n_columns) && row >= 0 &&
                         row < static_cast<double>(grid.n_rows);
  if (!is_within) return std::nullopt;
  const Index point = static_cast<Index>(row) * grid.n_columns + static_cast<Index>(column);
  const bool is_open =
      (*plane.places)[static_cast<std::size_t>(point)] == radiosity::PointPlace::open;
  return is_open ? std::optional(PlaneHit{distance, point}) : std::nullopt;
}

std::optional<double> plane_value_at(const Desk& desk, double x, double y) {
  const auto found = seen_plane(desk, x, y);
  if (!found) return std::nullopt;
  if (const auto grid = shown_grid(desk)) return grid->values[found->point];
  return measured_values(desk.session,
                         desk.meter.readings()->plane->irradiance.row(found->point))[0];
}

bool add_meter_at(Desk& desk, double x, double y) {
  if (const auto found = seen_plane(desk, x, y)) {
    const radiosity::Camera camera = picture_camera(desk);
    const double aspect = static_cast<double>(desk.region.width) / desk.region.height;
    const Vec3 place = camera.position + found->distance * ray_direction(camera, x, y, aspect);
    desk.meter.add({.position = place, .normal = shown_plane(desk).grid->normal()});
    return true;
  }
  const auto hit = hit_at(desk, x, y);
  if (!hit) return false;
  const radiosity::PatchMesh& mesh = *desk.session.model().mesh;
  const Vec3& normal = mesh.normal[hit->patch];
  Vec3 position = point_towards(desk, x, y);
  position -= normal.dot(position - mesh.centroid[hit->patch]) * normal;  // rays are not as exact
  desk.meter.add({.position = position,
                  .normal = normal,
                  .surface = mesh.surface_names[mesh.surface[hit->patch]]});
  return true;
}

void add_meter(Desk& desk, const Vec3& position, const Vec3& normal) {
  check_scene(desk);
  if (!(normal.norm() > 0)) throw std::invalid_argument("a normal needs a length");
  desk.meter.add({.position = position, .normal = normal.normalized()});
}

void take_tape(Desk& desk, bool is_taken) {
  desk.tape = {.is_in_hand = is_taken};
  if (is_taken) desk.is_meter_in_hand = false;
}

void take_meter(Desk& desk, bool is_taken) {
  desk.is_meter_in_hand = is_taken;
  if (is_taken) desk.tape.is_in_hand = false;
}

Eigen::VectorXd measured_values(const Session& session, const Eigen::MatrixXd& irradiance) {
  const radiosity::Bands& bands = session.model().bands;
  if (session.is_thermal()) return radiosity::mean_over_bands(irradiance, bands.wavelengths);
  return irradiance * radiosity::luminous_weights(bands);
}

const char* measured_unit(const Session& session) { return session.is_thermal() ? "W/m²" : "lux"; }

std::optional<double> meter_value(const Desk& desk, std::size_t point) {
  const Readings* readings = desk.meter.readings();
  const auto k = static_cast<Index>(point);
  if (readings == nullptr || k >= readings->points.rows()) return std::nullopt;
  // Points before it may have been taken away meanwhile.
  if (readings->task.points[point].position != desk.meter.points()[point].position) {
    return std::nullopt;
  }
  return measured_values(desk.session, readings->points.row(k))[0];
}

std::optional<radiosity::GridSummary> plane_summary(const Desk& desk) {
  const Readings* readings = desk.meter.readings();
  if (readings == nullptr || !readings->plane) return std::nullopt;
  return summary(readings->plane->places,
                 measured_values(desk.session, readings->plane->irradiance));
}

bool is_measuring(const Desk& desk) {
  return desk.meter.is_busy() || desk.plan.is_busy() || desk.network.is_busy() ||
         desk.summing.is_busy();
}

std::string readings_note(const Desk& desk) {
  if (desk.meter.is_current(desk.session)) return "";
  const WorkStatus status = desk.meter.status();
  if (status.is_busy && status.total > 0) {
    return fmt::format("being measured, {:.0f} %", 100 * status.done / status.total);
  }
  if (desk.meter.is_busy()) return "being measured";
  const bool is_coming = !desk.session.is_settled() || desk.session.is_previewing();
  return is_coming ? "waits for the light to be solved" : "not measured: there is no solved light";
}

void save_readings(const Desk& desk, const std::string& path) {
  if (io::lower_case_extension(path) != ".csv") {
    throw radiosity::OutputError(path + ": expected a name that ends in .csv");
  }
  const Readings* readings = desk.meter.readings();
  if (readings == nullptr) throw radiosity::OutputError("nothing has been measured yet");
  if (const std::string note = readings_note(desk); !note.empty()) {
    throw radiosity::OutputError(path + ": not saved: " + note);
  }
  check_output(desk, path);
  Eigen::VectorXd weights;
  if (!desk.session.is_thermal()) {
    weights = radiosity::luminous_weights(desk.session.model().bands);
  }
  io::write_readings_csv(path, all_readings(*readings), weights);
}

}  // namespace viewer
