#include <pybind11/pybind11.h>

#include <string>

#include "python/bindings/errors.h"
#include "python/bindings/light.h"
#include "python/bindings/operator.h"
#include "python/bindings/scene.h"
#include "python/bindings/scene_study.h"
#include "python/bindings/study_options.h"
#include "radiosity/solve/quantity.h"
#include "radiosity/version.h"

/// What the Python package radiosity/ stands on, which checks all arguments.
PYBIND11_MODULE(_core, module) {
  module.attr("__version__") = std::string(radiosity::kVersion);
  module.attr("WHITE_EFFICACY") = radiosity::kWhiteEfficacy;
  python::translate_errors();
  python::bind_scene(module);
  python::bind_operator(module);
  python::bind_study_options(module);
  python::bind_light(module);
  python::bind_study(module);
}
