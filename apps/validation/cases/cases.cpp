#include "apps/validation/cases/cases.h"

namespace apps::validation {

const std::vector<Case>& all_cases() {
  static const std::vector<Case> cases = {
      {"form-factors", "Form factors against closed forms", run_form_factors},
      {"furnace", "White furnace: uniform rooms", run_furnace},
      {"sphere", "Inside of a sphere", run_sphere},
      {"plates", "Two plates, two-surface enclosures, heat between grey plates", run_plates},
      {"cube", "Cube of six patches", run_cube},
      {"room", "Mean indirect irradiance of a room", run_room},
      {"cie-171", "CIE 171: light between diffuse surfaces", run_cie171},
      {"cie-171-lamps", "CIE 171: luminaires", run_cie171_lamps},
      {"cie-171-sky", "CIE 171: daylight of standard skies", run_cie171_sky},
      {"cie-171-facade", "CIE 171: glazed and obstructed facades", run_cie171_facade},
      {"energy", "Energy balance of every scene", run_energy},
      {"hemisphere-vs-area", "Irradiance by rays and by form factors", run_hemisphere},
      {"cornell-box", "Cornell box against path tracing", run_cornell_box},
      {"cornell-box-spectral", "Cornell box, measured spectra", run_spectral},
      {"scale", "Compressed operators of many patches", run_scale},
      {"convergence", "Convergence with finer patches", run_convergence},
  };
  return cases;
}

const Case* find_case(const std::string& name) {
  for (const Case& known : all_cases()) {
    if (known.name == name) return &known;
  }
  return nullptr;
}

}  // namespace apps::validation
