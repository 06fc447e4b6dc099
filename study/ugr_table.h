#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "radiosity/scene/photometry.h"
#include "study/study_events.h"

namespace study {

/// A room of the table, in units of H, the height of the luminaires above the eye.
struct UgrRoom {
  double across = 2;  ///< X, across the line of sight
  double along = 2;   ///< Y, along it
};

/// Reflectances of ceiling, walls and floor.
using UgrReflectances = std::array<double, 3>;

/// How the rooms of CIE 117 (and 190) look: their sizes, ...
std::vector<UgrRoom> usual_ugr_rooms();
/// ... and 70/50/20, 70/30/20, 50/50/20, 50/30/20 and 30/30/20 %.
std::vector<UgrReflectances> usual_ugr_reflectances();

struct UgrTableOptions {
  std::vector<UgrRoom> rooms = usual_ugr_rooms();
  std::vector<UgrReflectances> reflectances = usual_ugr_reflectances();
  double height = 2;      ///< H, m, > 0
  double spacing = 0.25;  ///< of the luminaires, in units of H; sides of rooms are whole multiples
  long n_patches = 300;   ///< of a room
};

/// UGR = 8 lg (0.25 / L_b Σ L² ω / p²) of rooms full of one luminaire.
struct UgrTable {
  UgrTableOptions made_by;
  /// Rooms x reflectances, looking along the luminaires' C0; -inf where nothing dazzles.
  Eigen::MatrixXd along_c0;
  Eigen::MatrixXd along_c90;  ///< the same along C90
};

/// The table of a luminaire with its own flux, by radiosity. As in CIE 117 a room reaches from the
/// eye to the luminaires, which hang in regular rows, half a spacing from the walls; somebody in
/// the middle of a wall, at its foot, looks level at the wall opposite; and L_b = E / π with the
/// mean of the indirect illuminance of the walls. Not as there: the light is that of the file's
/// candela and goes between patches, not zones; p is by Guth's formula (radiosity::position_index).
/// What the luminaire gives upwards falls onto the ceiling just above it. Throws SceneError if it
/// has no luminous opening, and for options that make no rooms; Interrupted. Reports "rooms".
UgrTable make_ugr_table(const radiosity::Photometry& photometry,
                        const UgrTableOptions& options = {}, const StudyEvents& events = {});

}  // namespace study
