#include "study/study_options.h"

#include <algorithm>

namespace study {

using radiosity::Closed;

Closed closedness(const radiosity::Scene& scene, Closed asked) {
  if (asked != Closed::automatic || !scene.closed) return asked;
  return *scene.closed ? Closed::yes : Closed::no;
}

bool is_compressed(const StudyOptions& options) {
  return options.storage == Storage::memory && options.transport == TransportKind::compressed &&
         !options.patches.adaptive;
}

double iteration_tolerance(double tolerance) { return std::min(1e-8, 1e-3 * tolerance); }

}  // namespace study
