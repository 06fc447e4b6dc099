#include <pybind11/pybind11.h>

#include <string>

#include "python/bindings/errors.h"
#include "python/bindings/light.h"
#include "python/bindings/operator.h"
#include "python/bindings/photometry.h"
#include "python/bindings/scene.h"
#include "python/bindings/scene_study.h"
#include "python/bindings/study_options.h"
#include "radiosity/solve/quantity.h"
#include "radiosity/version.h"

/// What the Python package radiosity/ stands on, which checks all arguments.
PYBIND11_MODULE(_core, module) {
  module.attr("__version__") = std::string(radiosity::kVersion);
  module.attr("WHITE_EFFICACY") = radiosity::kWhiteEfficacy;
  // Older ones take NumPy 2 for NumPy 1, and read zeros.
  module.attr("TAKES_NUMPY_2") = PYBIND11_VERSION_HEX >= 0x020C0000;
  python::translate_errors();
  python::bind_scene(module);
  python::bind_operator(module);
  python::bind_photometry(module);
  python::bind_study_options(module);
  python::bind_light(module);
  python::bind_study(module);
}
