#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "radiosity/base/geometry.h"
#include "radiosity/picture/measured_grid.h"
#include "radiosity/picture/point_grid.h"
#include "viewer/work/session.h"
#include "viewer/work/worker.h"

namespace viewer {

/// A place where light is measured by itself.
struct MeterPoint {
  radiosity::Vec3 position = radiosity::Vec3::Zero();  ///< m
  radiosity::Vec3 normal = radiosity::Vec3::UnitZ();   ///< unit; it measures what arrives there
  std::string surface = {};                            ///< that it lies on; "" in free space
};

/// What is to be measured.
struct MeterTask {
  std::optional<radiosity::WorkPlaneOptions> plane = {};
  radiosity::Vec3 up = radiosity::Vec3::UnitZ();  ///< of the plane
  std::vector<MeterPoint> points = {};
};

/// What was measured.
struct Readings {
  MeterTask task;
  std::optional<radiosity::MeasuredGrid> plane = {};
  Eigen::MatrixXd points;  ///< irradiance of the task's points, W/m², n x b
};

/// Measures the light on a work plane and at single points in the background: of solved light, and
/// anew when that changes.
class LightMeter {
 public:
  /// Measures the plane, or none any more. A plane that does not fit tells so by `take_error`.
  void set_plane(const std::optional<radiosity::WorkPlaneOptions>& plane);
  [[nodiscard]] const std::optional<radiosity::WorkPlaneOptions>& plane() const {
    return task_.plane;
  }
  void add(const MeterPoint& point);
  /// Throws std::out_of_range if there is no such point.
  void remove(std::size_t point);
  void clear_points();
  [[nodiscard]] const std::vector<MeterPoint>& points() const { return task_.points; }
  /// Forgets all: it was about another scene.
  void reset();

  /// Takes in what was measured, and begins to measure what has changed. Whether there was
  /// something.
  bool update(const Session& session, const radiosity::Vec3& up);
  /// The latest ones, perhaps of light or a task before; null if there are none.
  [[nodiscard]] const Readings* readings() const { return readings_.get(); }
  [[nodiscard]] std::shared_ptr<const Readings> shared_readings() const { return readings_; }
  /// Whether they are of the light and the task of now.
  [[nodiscard]] bool is_current(const Session& session) const;
  [[nodiscard]] bool is_busy() const { return worker_.is_busy(); }
  [[nodiscard]] WorkStatus status() const { return worker_.status(); }
  /// Why the latest task failed, once.
  std::optional<std::string> take_error() { return worker_.take_error(); }

 private:
  /// What measuring takes, of one light.
  struct Gathering;
  /// Of what a measurement was begun.
  struct Begun {
    std::shared_ptr<const radiosity::PatchMesh> mesh;
    std::shared_ptr<const Light> light;
    int task = -1;
  };
  [[nodiscard]] bool is_empty() const { return !task_.plane && task_.points.empty(); }
  void start(const Known& known);

  MeterTask task_;
  int task_version_ = 0;
  Begun begun_;
  Begun measured_;  // that the readings are of
  std::shared_ptr<const Readings> readings_;
  std::shared_ptr<const Gathering> gathering_;
  Session::Versions seen_ = {};
  int seen_task_ = -1;
  Worker worker_;  // last, so that it ends first
};

}  // namespace viewer
