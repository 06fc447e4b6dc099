#pragma once

#include "radiosity/scene/luminaire.h"
#include "radiosity/scene/photometry.h"

namespace radiosity {

/// What lamps give in a luminaire whose axis is so far from straight down, radian, of what they
/// gave when measured: linear between the angles of the table, the last factor beyond them.
double tilt_factor(const LampTilt& tilt, double angle);

/// Between a luminaire's axis and straight down, radian.
double tilt_angle(const Luminaire& luminaire);

/// The factor of a luminaire as it hangs.
double tilt_factor(const Luminaire& luminaire, const Photometry& photometry);

/// The luminaire's flux undimmed, lm: its own or its web's, and what its lamps make of that as it
/// hangs.
double undimmed_flux(const Luminaire& luminaire, const Photometry& photometry);

/// cd of a luminaire for each one of its web's.
double web_factor(const Luminaire& luminaire, const Photometry& photometry);

}  // namespace radiosity
