#pragma once

#include <pybind11/pybind11.h>

#include "radiosity/solve/discretisation_error.h"
#include "radiosity/solve/solution.h"

namespace python {

/// The arrays and figures of a solution, which is used up.
pybind11::dict light_dict(radiosity::Solution solution,
                          const radiosity::DiscretisationError& discretisation);

/// `solve`, `importance` and `point_factors`, which need no scene.
void bind_light(pybind11::module_& module);

}  // namespace python
