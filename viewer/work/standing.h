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

Standing standing(const Session& session);

/// What was reached and what was asked: "± 0.8 % reached (2 σ), 1 % asked"; "" until it is known.
std::string accuracy_text(const Session& session);

}  // namespace viewer
