#pragma once

/// The one header to read: from a scene to its radiosity.
///
///     const Scene scene = io::read_scene("scenes/cornell-box.json");
///     const PatchMesh mesh = meshing::make_patches(scene, {.max_edge = 0.05});
///     const Visibility visibility(mesh);
///     const auto transport = make_transport(mesh, visibility, {.tolerance = 1e-3});
///     const Solution solution = solve(*transport, exitance(scene, mesh), reflectance(scene,
///     mesh)); io::write("cornell-box.vtp", mesh, solution);
///
/// Conventions, stated once:
///  - SI units: metre, square metre, W/m² per band, kelvin, radian. Files convert at the boundary.
///  - A patch is a triangle or planar convex quad, counter-clockwise seen from its emitting side. A
///    surface is one-sided unless the scene says `two_sided`; then each polygon gives two patches
///    back to back. The back of a one-sided surface blocks light; it neither reflects nor emits.
///  - G_ij = A_i F_ij, the exchange area in m², is stored once per pair: reciprocity is exact.
///    F_ij = 1/A_i ∫_Ai ∫_Aj cosθ_i cosθ_j / (π r²) V(x,y) dA_j dA_i is the fraction of the power
///    leaving i that reaches j; Σ_j F_ij <= 1, with equality in a closed scene.
///  - B = M_e + ρ H with H = F B, per band: radiosity B, radiant exitance M_e (self-emitted),
///  irradiance
///    H, all W/m²; reflectance ρ in [0, 1]. B / π is radiance, W/(m² sr).
///  - Bands: one grey band and the three of linear RGB (Rec. 709 primaries) hold all the power that
///    they stand for, W/m². The bands of a wavelength list hold spectral densities at those
///    wavelengths, W/(m² nm); integrals over wavelength are by the trapezoidal rule on the list.
///  - Photometric quantities: of wavelengths X_v = 683 lm/W ∫ V(λ) X_λ dλ, V = ȳ of the CIE 1931 2°
///    observer, 0 outside 360..830 nm; of RGB and grey, by convention, an efficacy (179 lm/W unless
///    told otherwise) times 0.2126 R + 0.7152 G + 0.0722 B, or times the grey band.
///  - Arrays have one row per patch and one column per band.

#include "radiosity/camera_view.h"
#include "radiosity/color_matching.h"
#include "radiosity/discretisation_error.h"
#include "radiosity/error.h"
#include "radiosity/exchange_area.h"
#include "radiosity/final_gather.h"
#include "radiosity/gathered_picture.h"
#include "radiosity/geometry.h"
#include "radiosity/importance.h"
#include "radiosity/parallel.h"
#include "radiosity/patch_mesh.h"
#include "radiosity/point_factors.h"
#include "radiosity/progress.h"
#include "radiosity/quantity.h"
#include "radiosity/radiometry.h"
#include "radiosity/render.h"
#include "radiosity/sampled_destinations.h"
#include "radiosity/scene.h"
#include "radiosity/shooting_preview.h"
#include "radiosity/solve.h"
#include "radiosity/streamed_factors.h"
#include "radiosity/surface_factors.h"
#include "radiosity/transport.h"
#include "radiosity/visibility.h"
