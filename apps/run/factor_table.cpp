#include "apps/run/factor_table.h"

#include <algorithm>

#include "io/base/extension.h"
#include "io/mesh/vs3_records.h"
#include "io/result/surface_csv.h"
#include "io/result/view3d_file.h"
#include "radiosity/operator/surface_factors.h"

namespace apps {
namespace {

/// Of the first `n` surfaces.
io::View3dTable view3d_table(const radiosity::Scene& scene, const radiosity::PatchMesh& mesh,
                             const Eigen::MatrixXd& factors, Eigen::Index n) {
  io::View3dTable table{.areas = radiosity::surface_areas(mesh).head(n),
                        .factors = factors.topLeftCorner(n, n),
                        .emissivities = Eigen::VectorXd(n)};
  for (Eigen::Index s = 0; s < n; ++s) {
    const auto& surface = scene.surfaces[static_cast<std::size_t>(s)];
    const auto& material = scene.materials[static_cast<std::size_t>(surface.material)];
    table.emissivities[s] = 1 - material.reflectance.mean();  // of the bands
  }
  return table;
}

Eigen::Index n_obstructions(const io::Vs3File& file) {
  return std::count_if(file.surfaces.begin(), file.surfaces.end(), [](const auto& surface) {
    return surface.kind == io::Vs3Surface::Kind::obstruction;
  });
}

}  // namespace

void write_factor_table(const std::string& path, const radiosity::Scene& scene,
                        const radiosity::PatchMesh& mesh, const Eigen::MatrixXd& factors,
                        bool is_closed) {
  if (io::lower_case_extension(path) != ".txt") {
    io::write_surface_csv(path, mesh, factors);
    return;
  }
  Eigen::Index n = factors.rows();
  io::View3dOptions options;
  if (io::lower_case_extension(scene.source) == ".vs3") {
    const io::Vs3File file = io::read_vs3_records(scene.source, {});
    options = {.is_script_f = file.control.is_script_f, .is_binary = file.control.is_binary};
    is_closed = file.control.is_enclosure;
    n -= n_obstructions(file);  // which come last
  }
  io::View3dTable table = view3d_table(scene, mesh, factors, n);
  table.is_enclosure = is_closed;
  io::write_view3d(path, table, options);
}

}  // namespace apps
