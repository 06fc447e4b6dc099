#pragma once

#include <Eigen/Core>

#include "radiosity/scene/patch_mesh.h"
#include "radiosity/scene/smooth_corners.h"

namespace radiosity {

/// Values at the corners of each patch, for smooth display: row 4 i + k is corner k of patch i
/// (the fourth row of a triangle repeats its third), in the unit and number of bands (columns) of
/// `patch_values`, which has one row per patch.
///
/// Patches are joined where they meet at a corner, lie on the same surface and bend by at most
/// `crease_angle` (radian); a value never comes from across a crease or from another surface. Each
/// patch gets a gradient by least squares from those it is joined to at its corners; a corner's
/// value is the mean of its patches' linear extrapolations to it, weighted by their angles there.
/// It is kept between its patches' extremes, which at the border of a surface are first widened by
/// a quarter: corners overshoot nowhere inside, and linear fields are exact if at the border they
/// change by less than that in half a patch. Constant fields are exact to the last bit. Patches of
/// exactly 0, which lie in the dark under something, keep that and are joined to none.
///
/// A corner that lies on the edge of another patch of its surface (T-vertex) takes that edge's
/// value, so that no crack shows.
Eigen::MatrixXd corner_values(const PatchMesh& mesh, const Eigen::MatrixXd& patch_values,
                              double crease_angle = 0.35);

/// `corner_values` of many fields on the same patches: what depends on the patches alone is found
/// once.
class CornerInterpolation {
 public:
  /// Refers to `mesh`, which must outlive it.
  explicit CornerInterpolation(const PatchMesh& mesh, double crease_angle = 0.35)
      : mesh_(mesh), groups_(make_smooth_corners(mesh, crease_angle)) {}

  /// As `corner_values` returns them.
  [[nodiscard]] Eigen::MatrixXd values(const Eigen::MatrixXd& patch_values) const;

 private:
  const PatchMesh& mesh_;
  SmoothCorners groups_;
};

}  // namespace radiosity
