#include "study/study_options.h"

#include <algorithm>

namespace study {

using radiosity::Closed;

/// Up to so many patches a dense operator takes seconds, and is more exact.
constexpr radiosity::Index kMostDense = 12000;

Closed closedness(const radiosity::Scene& scene, Closed asked) {
  if (asked != Closed::automatic || !scene.closed) return asked;
  return *scene.closed ? Closed::yes : Closed::no;
}

bool is_compressed(const StudyOptions& options, radiosity::Index n_patches) {
  if (options.storage != Storage::memory) return false;
  if (options.transport != TransportKind::automatic) {
    return options.transport == TransportKind::compressed;
  }
  const bool needs_rows = options.patches.adaptive ||
                          options.method == radiosity::Method::gauss_seidel ||
                          options.method == radiosity::Method::southwell;
  return n_patches > kMostDense && !needs_rows;
}

double iteration_tolerance(double tolerance) { return std::min(1e-8, 1e-3 * tolerance); }

}  // namespace study
