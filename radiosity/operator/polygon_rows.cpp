#include "radiosity/operator/polygon_rows.h"

#include <algorithm>
#include <string>
#include <utility>

#include "radiosity/base/error.h"

namespace radiosity {

Index n_polygons(const PatchMesh& mesh) {
  if (mesh.n_polygons() > 0) return mesh.n_polygons();
  const auto last = std::max_element(mesh.polygon.begin(), mesh.polygon.end());
  return last == mesh.polygon.end() ? 0 : *last + 1;
}

PolygonRows::PolygonRows(const PatchMesh& mesh, Visitor visit)
    : mesh_(mesh), visit_(std::move(visit)), exchange_(Eigen::VectorXd::Zero(n_polygons(mesh))) {
  for (Index i = 0; i < mesh.size(); ++i) {
    if (mesh.twin[i] >= 0) {
      throw SolveError("surface '" + mesh.surface_names[mesh.surface[i]] +
                       "' has two sides, of which form factors between polygons know one only");
    }
  }
  if (!std::is_sorted(mesh.polygon.begin(), mesh.polygon.end())) {
    throw SolveError("the patches do not come in the order of their polygons");
  }
}

void PolygonRows::add_row(Index i, const Eigen::VectorXd& row) {
  area_ += mesh_.area[i];
  for (Index j = 0; j < row.size(); ++j) exchange_[mesh_.polygon[j]] += mesh_.area[i] * row[j];
  const bool is_last = i + 1 == mesh_.size() || mesh_.polygon[i + 1] != mesh_.polygon[i];
  if (!is_last) return;
  visit_(mesh_.polygon[i], exchange_ / area_);
  exchange_.setZero();
  area_ = 0;
}

}  // namespace radiosity
