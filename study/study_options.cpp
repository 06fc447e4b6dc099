#include "study/study_options.h"

#include <algorithm>

namespace study {

using radiosity::Closed;

Closed closedness(const radiosity::Scene& scene, Closed asked) {
  if (asked != Closed::automatic || !scene.closed) return asked;
  return *scene.closed ? Closed::yes : Closed::no;
}

double factor_tolerance(const StudyOptions& options) {
  return options.factor_tolerance.value_or(options.tolerance);
}

radiosity::TransportChoice transport_choice(const radiosity::Scene& scene,
                                            const StudyOptions& options) {
  const bool by_rows = options.method == radiosity::Method::gauss_seidel ||
                       options.method == radiosity::Method::southwell;
  if (scene.symmetry.is_none()) return {.kind = options.transport, .by_rows = by_rows};
  if (options.transport == radiosity::TransportKind::compressed) {
    radiosity::refuse_compressed_part();
  }
  return {.kind = radiosity::TransportKind::dense, .by_rows = by_rows};
}

double iteration_tolerance(double tolerance) { return std::min(1e-8, 1e-3 * tolerance); }

}  // namespace study
