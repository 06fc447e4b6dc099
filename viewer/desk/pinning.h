#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>

#include "viewer/desk/comparison.h"
#include "viewer/desk/desk.h"

namespace viewer {

/// Keeps the light as it is, to compare later light with it. Throws std::runtime_error if there is
/// none.
void pin(Desk& desk);
/// Gives it up.
void unpin(Desk& desk);

/// Why light cannot be compared so; "" if it can.
std::string comparison_refusal(const Desk& desk, Comparison comparison);
/// Compares so from now on, on a scale that fits. Throws std::runtime_error with the refusal.
void compare(Desk& desk, Comparison comparison);
/// Goes on to the next way to compare that there is.
void compare_otherwise(Desk& desk);
/// Moves the line between pinned light, to its left, and that of now: from 0 to 1 of the picture's
/// width.
void set_split(Desk& desk, double split);

/// How light is compared in the picture: not by what is asked for where that cannot be.
Comparison shown_comparison(const Desk& desk);
/// The pinned light if its difference is shown, else null.
std::shared_ptr<const Pinned> subtracted_light(const Desk& desk);
/// What the selected patch receives of the pinned light, W/m² per band; empty if none is pinned of
/// the patches that are open.
std::optional<Eigen::VectorXd> pinned_irradiance(const Desk& desk);

}  // namespace viewer
