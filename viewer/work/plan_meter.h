#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "study/measured_plan.h"
#include "study/requirement_check.h"
#include "viewer/work/session.h"
#include "viewer/work/worker.h"

namespace viewer {

/// What was measured of a scene's grids and observers.
struct PlanReadings {
  study::MeasuredPlan measured;
  std::vector<study::RequirementCheck> checks;
};

/// Measures what the scene's own plan asks for (`Scene::light_plan`) in the background, as
/// `radiosity light` does: of solved light whose errors are known, and anew when that changes.
class PlanMeter {
 public:
  /// Whether it is to be measured at all.
  void set_wanted(bool is_wanted) { is_wanted_ = is_wanted; }
  [[nodiscard]] bool is_wanted() const { return is_wanted_; }
  /// Forgets all: it was about another scene.
  void reset();

  /// Takes in what was measured, and begins to measure what has changed. Whether there was
  /// something. What it warns of goes to the session's console.
  bool update(Session& session);
  /// The latest ones, perhaps of light before; null if there are none.
  [[nodiscard]] std::shared_ptr<const PlanReadings> readings() const { return readings_; }
  /// Whether they are of the light of now.
  [[nodiscard]] bool is_current(const Session& session) const;
  [[nodiscard]] bool is_busy() const { return worker_.is_busy(); }
  [[nodiscard]] WorkStatus status() const { return worker_.status(); }

 private:
  void start(const Session& session);

  bool is_wanted_ = false;
  std::shared_ptr<const Light> begun_;     // of what the latest measurement was begun
  std::shared_ptr<const Light> measured_;  // that the readings are of
  std::shared_ptr<const PlanReadings> readings_;
  std::vector<std::string> warnings_;  // of it, told once for each scene
  Worker worker_;                      // last, so that it ends first
};

/// Whether a scene has grids or observers that can be measured, not of heat; whether it has grids.
bool has_light_plan(const Session& session);
bool has_grids(const Session& session);

}  // namespace viewer
