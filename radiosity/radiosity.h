#pragma once

/// The one header to read: from a scene to its radiosity.
///
///     const Scene scene = io::read_scene("scenes/cornell-box.json");
///     const PatchMesh mesh = meshing::make_patches(scene, {.max_edge = 0.05});
///     const Visibility visibility(mesh);
///     const auto transport = make_transport(mesh, visibility, {.tolerance = 1e-3});
///     const Solution solution =
///         solve(*transport, exitance(scene, mesh), reflectance(scene, mesh));
///     io::write("cornell-box.vtp", mesh, solution);
///
/// Conventions, stated once:
///  - SI units: metre, square metre, W/m² per band, kelvin, radian. Files convert at the boundary.
///  - A patch is a triangle or planar convex quad, counter-clockwise seen from its emitting side. A
///    surface is one-sided unless the scene says `two_sided`; then each polygon gives two patches
///    back to back. The back of a one-sided surface blocks light; it neither reflects nor emits.
///  - G_ij = A_i F_ij, the exchange area in m², is stored once per pair: reciprocity is exact.
///    F_ij = 1/A_i ∫_Ai ∫_Aj cosθ_i cosθ_j / (π r²) V(x,y) dA_j dA_i is the fraction of the power
///    leaving i that reaches j; Σ_j F_ij <= 1, with equality in a closed scene.
///  - B = M_e + ρ H with H = F B, per band: radiosity B, radiant exitance M_e (self-emitted) and
///    irradiance H, all W/m²; reflectance ρ in [0, 1]. B / π is radiance, W/(m² sr).
///  - With a sun, luminaires or an environment: H = F B + H_0, H_0 their direct irradiance, so that
///    B = M_e + ρ H_0 + ρ F B (make_conditions, SolveOptions::incident).
///  - Bands: one grey band and the three of linear RGB (Rec. 709 primaries) hold all the power that
///    they stand for, W/m². The bands of a wavelength list hold spectral densities at those
///    wavelengths, W/(m² nm); integrals over wavelength are by the trapezoidal rule on the list.
///  - Photometric quantities: of wavelengths X_v = 683 lm/W ∫ V(λ) X_λ dλ, V = ȳ of the CIE 1931 2°
///    observer, 0 outside 360..830 nm; of RGB and grey, by convention, an efficacy (179 lm/W unless
///    told otherwise) times 0.2126 R + 0.7152 G + 0.0722 B, or times the grey band.
///  - Arrays have one row per patch and one column per band.

#include "radiosity/assembly/dense_memory.h"
#include "radiosity/base/error.h"
#include "radiosity/base/geometry.h"
#include "radiosity/base/machine_memory.h"
#include "radiosity/base/parallel.h"
#include "radiosity/base/progress.h"
#include "radiosity/compressed/make_transport.h"
#include "radiosity/exchange/cut_off.h"
#include "radiosity/exchange/evaluated_row.h"
#include "radiosity/exchange/point_factors.h"
#include "radiosity/exchange/sampled_destinations.h"
#include "radiosity/meter/glare.h"
#include "radiosity/meter/grid_light.h"
#include "radiosity/operator/joint_row.h"
#include "radiosity/operator/polygon_rows.h"
#include "radiosity/operator/surface_factors.h"
#include "radiosity/operator/transport.h"
#include "radiosity/picture/camera_view.h"
#include "radiosity/picture/final_gather.h"
#include "radiosity/picture/gathered_picture.h"
#include "radiosity/picture/lightmap.h"
#include "radiosity/picture/measured_grid.h"
#include "radiosity/picture/point_grid.h"
#include "radiosity/picture/render.h"
#include "radiosity/picture/shooting_preview.h"
#include "radiosity/polygon/exchange_area.h"
#include "radiosity/polygon/point_to_polygon.h"
#include "radiosity/scene/black_body.h"
#include "radiosity/scene/celsius.h"
#include "radiosity/scene/color_matching.h"
#include "radiosity/scene/emissivity_table.h"
#include "radiosity/scene/light_plan.h"
#include "radiosity/scene/patch_heat.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/scene/patch_texture.h"
#include "radiosity/scene/radiometry.h"
#include "radiosity/scene/scenario.h"
#include "radiosity/scene/scene.h"
#include "radiosity/scene/symmetry.h"
#include "radiosity/scene/whole_mesh.h"
#include "radiosity/solve/conditions.h"
#include "radiosity/solve/discretisation_error.h"
#include "radiosity/solve/exchange_network.h"
#include "radiosity/solve/importance.h"
#include "radiosity/solve/quantity.h"
#include "radiosity/solve/quantity_summary.h"
#include "radiosity/solve/solution.h"
#include "radiosity/solve/solve.h"
#include "radiosity/solve/solve_conditions.h"
#include "radiosity/solve/surface_flux.h"
#include "radiosity/solve/trapped_light.h"
#include "radiosity/stream/streamed_factors.h"
#include "radiosity/stream/streaming_memory.h"
#include "radiosity/visibility/incident_light.h"
#include "radiosity/visibility/visibility.h"
