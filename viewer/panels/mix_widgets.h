#pragma once

#include <cstddef>
#include <string>

#include "viewer/desk/desk.h"

namespace viewer {

/// Widgets that change a lamp or a material. Each needs an ImGui window and, beside others of its
/// kind, an ID of its own.

/// Whether a lamp is on.
void draw_emitter_switch(Desk& desk, std::size_t emitter);
/// How bright it is, with a mark at the file's value.
void draw_emitter_slider(Desk& desk, std::size_t emitter);
/// The same in words: "80 %".
std::string emitter_text(const Desk& desk, std::size_t emitter);

/// A patch of a material's colour.
void draw_material_color(const Desk& desk, std::size_t material);
/// Its mean reflectance, likewise.
void draw_material_slider(Desk& desk, std::size_t material);
/// The same in words: "ρ 0.705".
std::string material_text(const Desk& desk, std::size_t material);

}  // namespace viewer
