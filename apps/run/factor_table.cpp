#include "apps/run/factor_table.h"

#include <algorithm>
#include <filesystem>

#include "io/base/extension.h"
#include "io/mesh/energyplus_model.h"
#include "io/mesh/vs3_records.h"
#include "io/result/moose_csv.h"
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

io::ZoneFactors zone_factors(const radiosity::Scene& scene, const radiosity::PatchMesh& mesh,
                             const Eigen::MatrixXd& factors) {
  io::ZoneFactors table{.surfaces = mesh.surface_names, .zones = {}, .factors = factors};
  const std::string extension = io::lower_case_extension(scene.source);
  if (extension == ".idf" || extension == ".epjson") {
    for (const auto& surface : io::read_energyplus_model(scene.source, {}).surfaces) {
      table.zones.push_back(surface.enclosure);
    }
  } else {
    const std::string name =
        scene.name.empty() ? std::filesystem::path(scene.source).stem().string() : scene.name;
    table.zones.assign(mesh.surface_names.size(), name);
  }
  return table;
}

void write_factor_table(const std::string& path, FactorFormat format, const radiosity::Scene& scene,
                        const radiosity::PatchMesh& mesh, const FactorTable& table) {
  const Eigen::MatrixXd& factors = table.factors;
  bool is_closed = table.is_closed;
  if (format == FactorFormat::moose) return io::write_moose_csv(path, factors);
  if (format == FactorFormat::energyplus) {
    return io::write_energyplus_factors(path, zone_factors(scene, mesh, factors));
  }
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
  io::View3dTable view3d = view3d_table(scene, mesh, factors, n);
  view3d.is_enclosure = is_closed;
  io::write_view3d(path, view3d, options);
}

}  // namespace apps
