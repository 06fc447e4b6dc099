#pragma once

#include <imgui.h>

#include <optional>
#include <utility>

#include "radiosity/base/geometry.h"
#include "viewer/desk/desk.h"

namespace viewer {

/// Where a point of the scene appears in the window; empty if it lies behind the camera.
std::optional<ImVec2> project(const Desk& desk, const radiosity::Vec3& point);

/// The same of a line between two points, as far as it lies before the camera.
std::optional<std::pair<ImVec2, ImVec2>> project_piece(const Desk& desk, radiosity::Vec3 from,
                                                       radiosity::Vec3 to);

}  // namespace viewer
