#pragma once

#include <string>
#include <vector>

#include "apps/validation/cases/case.h"
#include "apps/validation/cases/factor_comparison.h"

namespace apps::validation {

struct FactorComparisons {
  std::vector<FactorComparison> comparisons;
  std::vector<std::string> left_out;  ///< entries of the file that are not compared, and why
};

/// Computes every form factor in form-factors.json. Throws SceneError if the file is missing or
/// has an entry of an unknown kind.
FactorComparisons compare_factors(const Context& context);

}  // namespace apps::validation
