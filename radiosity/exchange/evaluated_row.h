#pragma once

#include <cstdint>
#include <vector>

#include "radiosity/base/progress.h"
#include "radiosity/operator/joint_row.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/visibility/visibility.h"

namespace radiosity {

struct EvaluatedRowOptions {
  double tolerance = 1e-3;  ///< relative error asked of the form factors, > 0
  std::uint64_t seed = 0;   ///< of the visibility samples
  Progress progress{};
};

/// The form factors from some patches to each patch, evaluated one by one through the tree of the
/// patches: no other form factors are needed. Exact where visibility is proved. Same input, same
/// bits, at any number of threads. Throws Interrupted.
JointRow evaluated_row(const PatchMesh& mesh, const Visibility& visibility,
                       const std::vector<std::int32_t>& patches,
                       const EvaluatedRowOptions& options = {});

}  // namespace radiosity
