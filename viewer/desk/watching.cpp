#include "viewer/desk/watching.h"

#include <fmt/format.h>

#include <algorithm>

namespace viewer {

void play(Watching& watching, Look& look, const IterationRecord* record, double speed, double now) {
  const bool is_at_end =
      record != nullptr && record->is_complete && look.step + 1 >= record->frames.size();
  if (is_at_end) look.step = 0;
  watching.is_playing = true;
  watching.speed = std::clamp(speed, kSlowest, kFastest);
  watching.due = now + 1 / watching.speed;
}

bool advance(Watching& watching, Look& look, const IterationRecord& record, double now) {
  if (!watching.is_playing || record.frames.empty()) return false;
  // A speed that is raised counts at once.
  watching.due = std::min(watching.due, now + 1 / watching.speed);
  if (now < watching.due) return false;
  watching.due = now + 1 / watching.speed;
  const std::size_t last = record.frames.size() - 1;
  if (look.step < last) {
    ++look.step;
    return true;
  }
  if (record.is_complete) watching.is_playing = false;
  return false;
}

std::string watched_text(const Session& session, const Look& look) {
  const IterationRecord* record = session.iteration();
  const IterationFrame* frame = watched_frame(record, look);
  if (frame == nullptr) return "";
  std::string text = fmt::format("{}: {}", method_title(record->method),
                                 step_text(record->method, frame->iteration));
  if (session.is_iteration_stale()) text += ", of the scene as it was before";
  return text;
}

std::optional<StepFacts> step_facts(const Session& session, const Look& look) {
  const IterationFrame* frame = watched_frame(session.iteration(), look);
  const auto patch = session.selected();
  if (frame == nullptr || !patch || *patch >= frame->radiosity.rows()) return std::nullopt;
  return StepFacts{.radiosity = frame->radiosity.row(*patch).transpose().cast<double>(),
                   .unshot = frame->unshot.row(*patch).transpose().cast<double>()};
}

std::optional<radiosity::Index> shown_shooter(const Session& session, const Look& look) {
  const IterationFrame* frame = watched_frame(session.iteration(), look);
  return frame == nullptr ? std::nullopt : frame->shooter;
}

}  // namespace viewer
