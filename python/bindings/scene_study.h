#pragma once

#include <pybind11/pybind11.h>

namespace python {

/// `Study`: a scene, its form factors and its light.
void bind_study(pybind11::module_& module);

}  // namespace python
