#pragma once

#include <Eigen/Core>

#include "radiosity/base/geometry.h"
#include "radiosity/base/progress.h"
#include "radiosity/scene/patch_mesh.h"

namespace radiosity {

/// Where the power goes that leaves a point or a surface: shares of it, which add up to 1.
struct Destinations {
  Eigen::VectorXd surfaces;  ///< per surface: meets its emitting side
  double backs = 0;          ///< meets the backs of one-sided surfaces, which absorb it
  double sky = 0;            ///< leaves the scene

  [[nodiscard]] double sum() const { return surfaces.sum() + backs + sky; }
};

/// Form factors from a surface element at `point` (m) with unit `normal`, exact up to rounding: the
/// hemisphere is divided until each part shows few patches (Warnock 1969), which are then clipped
/// against each other. A patch whose plane holds the point is seen edge-on: it receives nothing and
/// hides nothing, so the point may lie on one (to 1e-6 of the scene's size if it faces the same
/// way). Where patches overlap in one plane, a front hides a back, but two fronts both count: the
/// sum then exceeds 1. The same bits at any number of threads. Throws Interrupted if asked to stop.
Destinations point_factors(const PatchMesh& mesh, const Vec3& point, const Vec3& normal,
                           const Progress& progress = {});

}  // namespace radiosity
