#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "radiosity/picture/measured_grid.h"
#include "study/measured_plan.h"
#include "viewer/desk/look.h"
#include "viewer/work/plan_meter.h"

namespace viewer {

struct Desk;

/// Shows a grid of the scene in the picture, with isolines. Throws std::out_of_range if it has no
/// such grid or no such quantity.
void show_grid(Desk& desk, const GridChoice& choice);

/// The index of the grid of that name in the scene's plan; empty if there is none.
std::optional<std::size_t> grid_named(const Desk& desk, const std::string& name);
/// Names of what a grid measures, the illuminance of its plane first.
std::vector<std::string> grid_quantities(const Desk& desk, std::size_t grid);

/// What a grid or an observer is worth in one respect, in words.
struct GridLine {
  std::string what;                 ///< "Em", "U0", "UGR"...
  std::string value;                ///< "512.3 lx"; "-" if there is none
  std::string required = {};        ///< ">= 500"; "" if nothing is
  std::optional<bool> is_met = {};  ///< of what is required
};

/// Em, Emin, Emax, U0, Ud and points of a grid, as `radiosity light` prints them; what is required
/// stands beside the light that it is required of. Empty until it is measured.
std::vector<GridLine> grid_lines(const Desk& desk, const GridChoice& choice);
/// UGR of each observer, by name.
std::vector<GridLine> observer_lines(const Desk& desk);
/// How many requirements are met: "4 of 6 required values met"; "" without any, or until measured.
std::string requirement_text(const Desk& desk);
bool are_requirements_met(const Desk& desk);

/// The chosen grid as it is drawn; empty if none is shown or it is not measured yet.
struct ShownGrid {
  radiosity::MeasuredGrid measured;  ///< without irradiance; empty of a list of points
  std::vector<radiosity::Vec3> points;
  Eigen::VectorXd values;  ///< per point
  std::string unit;        ///< of them: "lux", "cd/m²", "%"
  std::string title;       ///< "desks: illuminance"
};
std::optional<ShownGrid> shown_grid(const Desk& desk);

/// What keeps the grids from being of the light of now: "being measured, 40 %"; "" if nothing does.
std::string grids_note(const Desk& desk);

}  // namespace viewer
