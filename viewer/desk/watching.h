#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <string>

#include "viewer/desk/look.h"
#include "viewer/work/session.h"

namespace viewer {

/// How a recorded iteration is stepped through.
struct Watching {
  radiosity::Method method = radiosity::Method::jacobi;  ///< of the latest record, or the next one
  bool is_playing = false;
  double speed = 1;             ///< steps per second, in [kSlowest, kFastest]
  bool is_logarithmic = false;  ///< the plot's axis of work
  double due = 0;               ///< when the next step comes, s
};
inline constexpr double kSlowest = 0.25;
inline constexpr double kFastest = 30;

/// Begins to play `now` (s), from the start if the last step is shown. `speed` as above.
void play(Watching& watching, Look& look, const IterationRecord* record, double speed, double now);
/// Goes to the next step if it is due `now`, s, and ends at the last one. Whether it went.
bool advance(Watching& watching, Look& look, const IterationRecord& record, double now);

/// What the picture shows of a recorded iteration: "Jacobi: light after 3 reflections", and
/// whether that is of the scene as it was before a change; "" if it shows none.
std::string watched_text(const Session& session, const Look& look);

/// What the step that is shown knows of the selected patch, W/m², per band.
struct StepFacts {
  Eigen::VectorXd radiosity;
  Eigen::VectorXd unshot;
};
/// Empty if no patch is selected or no step is shown.
std::optional<StepFacts> step_facts(const Session& session, const Look& look);

/// The patch that shoots next, to be marked in the picture; empty if none does or no step is shown.
std::optional<radiosity::Index> shown_shooter(const Session& session, const Look& look);

}  // namespace viewer
