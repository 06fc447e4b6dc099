#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "viewer/desk/desk.h"
#include "viewer/desk/surface_totals.h"

namespace viewer {

/// Shows a surface, or hides it from picture and mouse. Throws std::out_of_range if there is none.
void set_shown(Desk& desk, std::int32_t surface, bool is_shown);
/// Hides all others. Likewise.
void isolate(Desk& desk, std::int32_t surface);
/// Outlines a surface, or none. Likewise.
void mark_surface(Desk& desk, std::optional<std::int32_t> surface);
/// The surfaces' totals as they are now, in the desk's order.
const std::vector<SurfaceTotal>& sorted_totals(Desk& desk);

}  // namespace viewer
