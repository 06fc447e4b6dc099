#pragma once

#include <pybind11/pybind11.h>

namespace python {

/// `Photometry`: what a photometric file says.
void bind_photometry(pybind11::module_& module);

}  // namespace python
