#include "viewer/work/standing.h"

#include <fmt/format.h>

#include <cmath>

#include "meshing/adaptive/adaptive.h"
#include "study/study_options.h"

namespace viewer {
namespace {

std::string known_text(const Session& session) {
  const std::string accuracy = accuracy_text(session);
  return accuracy.empty() ? "errors not known" : accuracy;
}

std::string preview_text(const Session& session) {
  const double unshot = 100 * session.unshot_share();
  const bool is_final = session.is_settled() && !session.is_previewing();
  const char* state = is_final ? ", stopped" : "";
  if (const auto error = session.light()->factor_error) {
    return fmt::format("preview{}: form factors to about {:.0f} %", state, std::ceil(100 * *error));
  }
  return unshot < 1
             ? fmt::format("preview{}: all but 1 % of the light is shot", state)
             : fmt::format("preview{}: {:.0f} % of the light still on its way", state, unshot);
}

}  // namespace

bool is_without_lamps(const Known& known) {
  const bool has_none = known.light && known.light->mix && known.light->mix->emitters.empty();
  return has_none && known.light->solution.radiosity.isZero(0);
}

Standing standing(const Session& session) {
  const Light* light = session.light();
  if (light == nullptr) return {};
  if (session.is_change_pending()) {
    return {.text = "not yet of the scene as it is now", .is_rough = true};
  }
  if (is_without_lamps(session.known())) return {.text = "no lamp: all is dark"};
  switch (light->kind) {
    case Light::Kind::preview:
      return {.text = preview_text(session), .is_rough = true};
    case Light::Kind::quick:
      return {.text = "solved to 0.1 %, being refined"};
    case Light::Kind::solved:
      return {.text =
                  session.is_settled() ? "solved, errors not known" : "solved, errors being found"};
    case Light::Kind::complete:
      return {.text = "solved, " + known_text(session), .is_result = true};
    case Light::Kind::stored:
      return {.text = "result from a file, " + known_text(session), .is_result = true};
  }
  return {};
}

std::string accuracy_text(const Session& session) {
  if (!session.has_result()) return "";
  const std::optional<double>& error = session.light()->relative_error;
  // Files of other programs may hold zeros for what they do not know.
  if (!error || *error == 0) return "";
  return fmt::format("known to ± {:.2g} % (2 σ)", 100 * *error);
}

std::string asked_text(const Session& session) {
  if (!session.model().scene) return "";  // a file does not tell
  const study::StudyOptions& options = session.options();
  if (!options.patches.adaptive) {
    return fmt::format("asked of the form factors: {:.2g} %",
                       100 * study::factor_tolerance(options));
  }
  return fmt::format("asked of the radiosity: {} σ within {:.2g} %", meshing::kErrorMargin,
                     100 * options.tolerance);
}

}  // namespace viewer
