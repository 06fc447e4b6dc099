#pragma once

#include <vector>

#include "apps/validation/cases/factor_comparison.h"
#include "apps/validation/reference/known_factors.h"

namespace apps::validation {

/// Form factors of disks, cylinders, cones and spheres that nothing obstructs, from facets that get
/// ever finer, extrapolated to the round shape. Each comparison has its own tolerance: how far two
/// successive extrapolations are apart. Empty if the entry is of no such kind.
std::vector<FactorComparison> compare_curved(const KnownFactor& known);

}  // namespace apps::validation
