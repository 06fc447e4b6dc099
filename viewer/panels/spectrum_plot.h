#pragma once

#include "viewer/desk/patch_facts.h"

namespace viewer {

/// Draws what leaves a patch and what arrives there over the wavelengths of its bands; the mouse on
/// a band tells its values. Needs light, at least two wavelengths and an ImGui window.
void draw_spectrum_plot(const PatchFacts& facts, const radiosity::Bands& bands);

}  // namespace viewer
