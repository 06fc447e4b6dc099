#include "study/study_options.h"

#include <algorithm>

namespace study {

using radiosity::Closed;

Closed closedness(const radiosity::Scene& scene, Closed asked) {
  if (asked != Closed::automatic || !scene.closed) return asked;
  return *scene.closed ? Closed::yes : Closed::no;
}

double iteration_tolerance(double tolerance) { return std::min(1e-8, 1e-3 * tolerance); }

}  // namespace study
