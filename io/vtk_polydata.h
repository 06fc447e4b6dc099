#pragma once

#include <vtkSmartPointer.h>

#include <filesystem>
#include <vector>

#include "radiosity/patch_mesh.h"
#include "radiosity/quantity.h"
#include "radiosity/solve.h"

class vtkPolyData;

namespace io {

/// A solution as VTK's data model: one polygon per patch, in patch order, with the mesh's vertices
/// as points (m). Cell arrays: radiosity, irradiance, exitance, reflectance, radiosity_error,
/// net_flux (float64, one component per band), area (float64, m²), surface, polygon (int32). Field
/// data: surface_names (strings, indexed by `surface`). The arrays of the solution have n_patches
/// rows. `quantities` are added by their column names, those of the same name once.
vtkSmartPointer<vtkPolyData> make_polydata(
    const radiosity::PatchMesh& mesh, const radiosity::Solution& solution,
    const std::vector<radiosity::QuantityField>& quantities = {});

/// Writes VTK XML (.vtp), zlib-compressed. Throws OutputError naming `path`.
void write_polydata(const std::filesystem::path& path, vtkPolyData& polydata);

}  // namespace io
