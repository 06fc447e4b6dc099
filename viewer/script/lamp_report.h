#pragma once

#include <nlohmann/json_fwd.hpp>

#include "viewer/desk/desk.h"

namespace viewer {

/// What the mix has of lamps and materials, for `state_report`.
nlohmann::json mix_json(const Session& session);
/// The scene's luminaires, and where they are in the picture.
nlohmann::json luminaires_json(const Desk& desk);

}  // namespace viewer
