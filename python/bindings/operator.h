#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <string>

#include "radiosity/operator/transport.h"
#include "radiosity/scene/patch_mesh.h"

namespace python {

/// Form factors of patches, and what they are worth.
struct Operator {
  std::shared_ptr<const radiosity::PatchMesh> mesh;
  std::shared_ptr<const radiosity::Transport> transport;
  double tolerance = 0;  ///< relative error that was asked of them
  std::string geometry;  ///< of the scene's surfaces (study::geometry_fingerprint)
};

/// `Operator`: products, rows, the sparse matrix, files; and what depends on a mesh alone.
void bind_operator(pybind11::module_& module);

}  // namespace python
