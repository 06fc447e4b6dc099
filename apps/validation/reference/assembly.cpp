#include "apps/validation/reference/assembly.h"

#include <utility>

#include "radiosity/assembly/make_transport.h"
#include "radiosity/scene/radiometry.h"
#include "radiosity/solve/solve.h"

namespace apps::validation {

using namespace radiosity;

namespace {

TransportOptions with_word_of(const Scene& scene, TransportOptions options) {
  if (options.closed == Closed::automatic && scene.closed) {
    options.closed = *scene.closed ? Closed::yes : Closed::no;
  }
  return options;
}

}  // namespace

Assembly assemble(Scene scene, const meshing::PatchOptions& patches,
                  const TransportOptions& options) {
  Assembly assembly{.scene = std::move(scene)};
  assembly.mesh = meshing::make_patches(assembly.scene, patches);
  assembly.visibility = std::make_unique<Visibility>(assembly.mesh);
  assembly.transport =
      make_transport(assembly.mesh, *assembly.visibility, with_word_of(assembly.scene, options));
  return assembly;
}

Assembly assemble_adaptively(Scene scene, const meshing::AdaptiveOptions& options) {
  Assembly assembly{.scene = std::move(scene)};
  meshing::AdaptiveOptions with_scene = options;
  with_scene.transport = with_word_of(assembly.scene, options.transport);
  meshing::AdaptiveMesh adaptive = meshing::make_adaptive_patches(assembly.scene, with_scene);
  assembly.mesh = std::move(adaptive.mesh);
  assembly.visibility = std::make_unique<Visibility>(std::move(adaptive.visibility));
  assembly.transport = std::move(adaptive.transport);
  return assembly;
}

Solution solve_own_light(const Assembly& assembly, const SolveOptions& options) {
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
