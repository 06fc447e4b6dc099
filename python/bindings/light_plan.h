#pragma once

#include <pybind11/pybind11.h>

#include "python/bindings/work.h"
#include "radiosity/scene/light_plan.h"
#include "study/study.h"

namespace python {

/// What a plan asks for of a study that has its light: "grids", a list with "name", "points",
/// "normals", "place", "shape" (rows, columns; None of a list) and "quantities", by name and light
/// an array of direct, indirect and error, n x 3, lux; "observers", a list with "name", "ugr",
/// "background" and "sources".
pybind11::dict measure(const study::Study& study, const study::StudyOptions& options,
                       const radiosity::LightPlan& plan, double efficacy, const WorkOptions& work);

/// Plans of points and of an observer.
void bind_light_plan(pybind11::module_& module);

}  // namespace python
