#pragma once

#include <string>

#include "viewer/work/worker.h"

namespace viewer {

/// Follows a job through its stages and tells a person how far it is and how long it may take.
class JobProgress {
 public:
  /// Whether the job has rounds, as of adaptive patches, nobody knows how many.
  void set_rounds(bool has_rounds) { has_rounds_ = has_rounds; }

  /// Takes in where the job stands `now`, s. It has ended once it is not busy; the next one begins
  /// anew.
  void update(const WorkStatus& status, double now);

  /// Done share of the whole job in [0, 1], as a guess: how many stages will follow is not known.
  /// Never falls while a job lasts.
  [[nodiscard]] double fraction() const { return fraction_; }
  /// "form factors 41 %, about 40 s left", or of a stage that does not tell how far it is "dividing
  /// into patches, 12 s so far"; with rounds "round 2: form factors 5 %, about 9 s of
  /// this round left". The time is that of the stage. "" if nothing is done.
  [[nodiscard]] std::string text() const;

 private:
  void begin_stage(const WorkStatus& status, double now);

  std::string stage_;
  double begun_ = 0;        // the stage, s
  double now_ = 0;          // s
  double done_ = 0;         // share of the stage
  double done_before_ = 0;  // share of the job, when the stage began
  double fraction_ = 0;
  bool is_silent_ = false;  // the stage does not tell how far it is
  int round_ = 0;           // of form factors
  bool is_busy_ = false;
  bool has_rounds_ = false;
};

/// Seconds as a person says them: "40 s", "3 min", "2 h".
std::string duration_text(double seconds);

}  // namespace viewer
