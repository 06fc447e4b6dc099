#include "radiosity/visibility/sun_edges.h"

#include <cmath>
#include <numeric>

#include "radiosity/scene/radiometry.h"
#include "radiosity/visibility/sun_shadows.h"
#include "radiosity/visibility/visible_sky.h"

namespace radiosity {

SunEdges find_sun_edges(const Scene& scene, const PatchMesh& mesh, const Progress& progress) {
  SunEdges edges{.deviation = Eigen::VectorXd::Zero(mesh.size())};
  if (!scene.sun || mesh.size() == 0) return edges;
  const SunShadows shadows(mesh, scene.sun->direction, panes_of(scene, mesh));
  const auto open = [](int, double) { return Eigen::VectorXd::Ones(1).eval(); };
  const Eigen::VectorXd share = shadows.shares_through_panes(1, open, progress);
  const Eigen::MatrixXd rho = reflectance(scene, mesh);
  double sum = 0;
  for (Index i = 0; i < mesh.size(); ++i) {
    const double whole = shadows.cosine(mesh.normal[i]) * rho.row(i).dot(scene.sun->irradiance) /
                         static_cast<double>(rho.cols());
    edges.deviation[i] = whole * std::sqrt(std::max(0., share[i] * (1 - share[i])));
    sum += mesh.area[i] * share[i] * whole * whole;
  }
  edges.typical = std::sqrt(sum / std::accumulate(mesh.area.begin(), mesh.area.end(), 0.));
  return edges;
}

}  // namespace radiosity
