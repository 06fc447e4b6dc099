#pragma once

#include <vtkSmartPointer.h>

#include <filesystem>
#include <optional>
#include <vector>

#include "radiosity/scene/patch_mesh.h"
#include "radiosity/scene/scene.h"
#include "radiosity/solve/quantity.h"
#include "radiosity/solve/solution.h"

class vtkPolyData;

namespace io {

/// Version of the arrays in a result file, to be raised when an older reader would misread them.
inline constexpr int kResultVersion = 1;

/// A solution as VTK's data model: one polygon per patch, in patch order, with the mesh's vertices
/// as points (m). Cell arrays: radiosity, irradiance, exitance, reflectance, radiosity_error,
/// net_flux (float64, one component per band), surface_temperature (float64, K, of heat), area
/// (float64, m²), surface, polygon, twin, family (int32). The arrays of the solution have n_patches
/// rows. `quantities` are added by their column names, those of the same name once. Field data:
/// surface_names (strings, indexed by `surface`), surface_two_sided (0 or 1), radiosity_version,
/// bands (bands_name; absent if `bands` are and they are neither one, grey, nor three, RGB),
/// wavelengths (nm), band_edges (µm, of heat), energy_emitted, energy_incident, energy_absorbed,
/// energy_escaped (one value per band), solve_method, solve_iterations, solve_converged,
/// solve_products, solve_residual, solve_error_bound, transport_error_bound, and `camera`, if there
/// is one: position (m), direction, up, vertical field of view (radian).
vtkSmartPointer<vtkPolyData> make_polydata(
    const radiosity::PatchMesh& mesh, const radiosity::Solution& solution,
    const std::vector<radiosity::QuantityField>& quantities = {},
    const std::optional<radiosity::Bands>& bands = {},
    const std::optional<radiosity::Camera>& camera = {});

/// Writes VTK XML (.vtp), zlib-compressed. Throws OutputError naming `path`.
void write_polydata(const std::filesystem::path& path, vtkPolyData& polydata);

}  // namespace io
