#pragma once

#include <string>
#include <vector>

#include "apps/validation/cases/case.h"

namespace apps::validation {

/// Every case, the quick and simple ones first.
const std::vector<Case>& all_cases();

/// The case of that name; none if there is none.
const Case* find_case(const std::string& name);

/// Form factors against closed forms.
CaseResult run_form_factors(const Context& context);
/// Closed rooms of uniform reflectance and exitance.
CaseResult run_furnace(const Context& context);
/// The cube of six patches, and rooms of two and three surfaces.
CaseResult run_cube(const Context& context);
CaseResult run_plates(const Context& context);
/// Emitted = absorbed + escaped in every scene that comes with the program.
CaseResult run_energy(const Context& context);

/// The inside of a sphere of facets.
CaseResult run_sphere(const Context& context);
/// Mean indirect irradiance of rooms of uniform reflectance.
CaseResult run_room(const Context& context);
/// Irradiance by rays over the hemisphere and by form factors.
CaseResult run_hemisphere(const Context& context);
/// Radiosity and error intervals against path tracing.
CaseResult run_cornell_box(const Context& context);
/// Many bands together and alone.
CaseResult run_spectral(const Context& context);
/// Compressed operators next to a dense one and path tracing.
CaseResult run_scale(const Context& context);
/// CIE 171:2006, light between diffuse surfaces.
CaseResult run_cie171(const Context& context);
/// CIE 171:2006, light of luminaires.
CaseResult run_cie171_lamps(const Context& context);
/// CIE 171:2006, daylight of the standard skies.
CaseResult run_cie171_sky(const Context& context);
/// Daylight through facades, after CIE 171:2006.
CaseResult run_cie171_facade(const Context& context);
/// Error against the number of patches.
CaseResult run_convergence(const Context& context);

}  // namespace apps::validation
