#include "study/study_options.h"

#include <algorithm>

#include "radiosity/base/error.h"

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
  const int n_ranks = options.ranks != nullptr ? options.ranks->size() : 1;
  if (by_rows && n_ranks > 1) {
    throw radiosity::SolveError(
        "this method goes by rows of all form factors, of which each rank has a share only: use "
        "--method cg, jacobi or chebyshev");
  }
  if (options.patches.adaptive && n_ranks > 1) {
    throw radiosity::SolveError(
        "patches are made adaptively by one process only: use --patches or --max-edge, or no "
        "ranks");
  }
  if (scene.symmetry.is_none()) {
    return {.kind = options.transport, .by_rows = by_rows, .n_ranks = n_ranks};
  }
  if (options.transport == radiosity::TransportKind::compressed) {
    radiosity::refuse_compressed_part();
  }
  return {.kind = radiosity::TransportKind::dense, .by_rows = by_rows, .n_ranks = n_ranks};
}

double iteration_tolerance(double tolerance) { return std::min(1e-8, 1e-3 * tolerance); }

}  // namespace study
