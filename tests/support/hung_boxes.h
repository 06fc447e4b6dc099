#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "radiosity/patch_mesh.h"
#include "radiosity/scene.h"

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

}  // namespace radiosity::test
