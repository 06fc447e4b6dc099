#include "apps/validation/reference/own_light.h"

#include "radiosity/scene/radiometry.h"
#include "radiosity/solve/solve.h"

namespace apps::validation {

using namespace radiosity;

Solution solve_own_light(const study::Study& assembly, const SolveOptions& options) {
  return solve(*assembly.transport, exitance(assembly.scene, assembly.mesh),
               reflectance(assembly.scene, assembly.mesh), options);
}

Eigen::Map<const Eigen::VectorXd> areas(const PatchMesh& mesh) {
  return {mesh.area.data(), mesh.size()};
}

Eigen::MatrixXd polygon_means(const PatchMesh& mesh, const Eigen::MatrixXd& values,
                              Index n_polygons) {
  Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(n_polygons, values.cols());
  Eigen::VectorXd total = Eigen::VectorXd::Zero(n_polygons);
  for (Index i = 0; i < mesh.size(); ++i) {
    sums.row(mesh.polygon[i]) += mesh.area[i] * values.row(i);
    total[mesh.polygon[i]] += mesh.area[i];
  }
  return sums.array().colwise() / total.array();
}

}  // namespace apps::validation
