#pragma once

#include <string>

#include "viewer/work/session.h"

namespace viewer {

/// How far the light that is shown can be trusted.
struct Standing {
  std::string text;        ///< "preview: 43 % of the light still on its way"; "" without light
  bool is_result = false;  ///< solved, of the scene as it is now, with its errors known
  bool is_rough = false;   ///< its third digit means nothing
};

/// Whether light is known that is none, as nothing in the scene gives any: there is no lamp that
/// could be switched on.
bool is_without_lamps(const Known& known);

Standing standing(const Session& session);

/// How well a result is known, in the same words wherever it is told: "known to ± 0.8 % (2 σ)",
/// which is `relative_error`; "" until it is known.
std::string accuracy_text(const Session& session);

/// What was asked when the scene was solved. It is no measure of the result: form factors to 1 %
/// say nothing of what the size of the patches costs. "" without a scene.
std::string asked_text(const Session& session);

}  // namespace viewer
