#pragma once

#include <memory>
#include <optional>

#include "radiosity/base/geometry.h"
#include "viewer/work/factor_row.h"
#include "viewer/work/iteration_record.h"
#include "viewer/work/light_path.h"
#include "viewer/work/model.h"

namespace viewer {

/// Sums over more of them take longer than the window's thread has.
inline constexpr radiosity::Index kManyPatches = 30'000;

/// What is known of the open scene at one time. Nothing of it changes, so that another thread may
/// work with a copy, which is cheap.
struct Known {
  Model model;
  std::shared_ptr<const Light> light;  ///< null until there is some
  std::optional<radiosity::Index> selected;
  std::shared_ptr<const FactorRow> row;         ///< of the selected patch; null until found
  std::shared_ptr<const LightPath> light_path;  ///< likewise
  std::shared_ptr<const IterationRecord> iteration;
};

}  // namespace viewer
