#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "radiosity/base/geometry.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/scene/scene.h"
#include "radiosity/solve/solution.h"

namespace radiosity::test {

/// A closed room, grey, 2 to 4 m wide, with 2 to 8 boxes in it, half of them turned, each 1 to 20
/// cm off a wall, the floor, the ceiling or another box; none touch, no two faces share a plane.
/// The first one emits. Reflectances from 0.2 to 0.8. One surface per wall and box. Same seed, same
/// room.
Scene make_hung_boxes(std::uint64_t seed);

/// The patches, each divided into four of one family: patch i into 4 i to 4 i + 3, about half as
/// large.
PatchMesh divided_into_four(const PatchMesh& mesh);

/// Area-weighted means over four rows each: values per patch of `finer` for the patches that were
/// divided.
Eigen::MatrixXd means_of_four(const PatchMesh& finer, const Eigen::MatrixXd& values);

/// How the first band of a solution fares against a better one of the same patches.
struct IntervalCheck {
  Index n_within = 0;   ///< patches off by two of their standard errors at most
  double error = 0;     ///< median of the patches, W/m²
  double interval = 0;  ///< median of two standard errors, W/m²
};

/// `rounding` (W/m²) is no error.
IntervalCheck check_intervals(const Solution& solution, const Eigen::MatrixXd& truth,
                              double rounding = 0);

}  // namespace radiosity::test
