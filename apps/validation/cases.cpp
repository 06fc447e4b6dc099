#include "apps/validation/cases.h"

namespace apps::validation {

const std::vector<Case>& all_cases() {
  static const std::vector<Case> cases = {
      {"form-factors", "Form factors against closed forms", run_form_factors},
      {"furnace", "White furnace: uniform rooms", run_furnace},
      {"cube", "Cube of six patches", run_cube},
      {"plates", "Two plates, two-surface enclosures, heat between grey plates", run_plates},
      {"energy", "Energy balance of every scene", run_energy},
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
