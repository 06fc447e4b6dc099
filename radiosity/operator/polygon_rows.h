#pragma once

#include <Eigen/Core>
#include <functional>

#include "radiosity/base/geometry.h"
#include "radiosity/scene/patch_mesh.h"

namespace radiosity {

/// Adds up rows of F between patches to rows between the polygons that they are parts of, as they
/// come: F_PQ = Σ_{i in P} A_i Σ_{j in Q} F_ij / Σ_{i in P} A_i.
class PolygonRows {
 public:
  /// Takes the row of a polygon, n_polygons.
  using Visitor = std::function<void(Index polygon, const Eigen::VectorXd& row)>;

  /// `mesh` must outlive this. Throws SolveError if its patches do not come in the order of their
  /// polygons, as those of two sides do not.
  PolygonRows(const PatchMesh& mesh, Visitor visit);

  /// Row i of the patches; they come one after the other, 0 to n - 1. The row of a polygon is
  /// visited with the last one of its patches.
  void add_row(Index i, const Eigen::VectorXd& row);

 private:
  const PatchMesh& mesh_;
  Visitor visit_;
  Eigen::VectorXd exchange_;  // of the polygon that is worked on, m²
  double area_ = 0;           // of its patches so far, m²
};

/// How many polygons the patches are parts of.
Index n_polygons(const PatchMesh& mesh);

}  // namespace radiosity
