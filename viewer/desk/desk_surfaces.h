#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "viewer/desk/desk.h"
#include "viewer/desk/surface_totals.h"

namespace viewer {

/// Shows surfaces, or hides them from picture and mouse. Throws std::out_of_range if there is no
/// such surface.
void set_shown(Desk& desk, std::span<const std::int32_t> surfaces, bool is_shown);
/// Hides all others. Likewise.
void isolate(Desk& desk, std::span<const std::int32_t> surfaces);
/// Outlines surfaces, or none. Likewise.
void mark_surfaces(Desk& desk, std::span<const std::int32_t> surfaces);

/// The surface that a person means: the only one that is marked or, if there is none such, that of
/// the asked patch; empty without a scene.
std::optional<std::int32_t> meant_surface(const Desk& desk);

/// The surfaces' totals in the desk's order: as they are now or, of very many patches, as they were
/// a moment ago.
const std::vector<SurfaceTotal>& sorted_totals(Desk& desk);

}  // namespace viewer
