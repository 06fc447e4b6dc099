#pragma once

#include <pybind11/pybind11.h>

namespace python {

/// `Scene`: reading, writing, making one of arrays, other lights and materials.
void bind_scene(pybind11::module_& module);

}  // namespace python
