#include "viewer/desk/status_parts.h"

#include <fmt/format.h>

#include "viewer/work/standing.h"

namespace viewer {

std::vector<std::string> status_parts(const Session& session) {
  const std::string job = session.job().text();
  const std::string ready = session.is_open() ? "ready" : "no scene";
  std::vector<std::string> parts = {(session.is_paused() ? "paused, " : "") +
                                    (job.empty() ? ready : job)};
  if (session.is_open()) parts.push_back(fmt::format("{} patches", session.model().mesh->size()));
  if (std::string accuracy = accuracy_text(session); !accuracy.empty()) {
    parts.push_back(std::move(accuracy));
  }
  if (session.seconds_to_solve() > 0) {
    parts.push_back(fmt::format("solved in {}", duration_text(session.seconds_to_solve())));
  }
  return parts;
}

}  // namespace viewer
