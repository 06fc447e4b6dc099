#pragma once

#include <pybind11/pybind11.h>

#include "study/study_options.h"

namespace python {

/// `StudyOptions`: what a scene's patches, form factors and light shall be.
void bind_study_options(pybind11::module_& module);

}  // namespace python
