#include "io/mesh/mesh_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <limits>

#include "io/base/extension.h"
#include "io/base/line_reader.h"
#include "io/base/rounding.h"
#include "io/mesh/energyplus_reader.h"
#include "io/mesh/foam_reader.h"
#include "io/mesh/gltf_files.h"
#include "io/mesh/gltf_reader.h"
#include "io/mesh/msh_reader.h"
#include "io/mesh/obj_reader.h"
#include "io/mesh/off_reader.h"
#include "io/mesh/ply_reader.h"
#include "io/mesh/read_vtk_mesh.h"
#include "io/mesh/stl_reader.h"
#include "io/mesh/vs3_reader.h"

namespace io {
namespace {

using radiosity::Progress;
using radiosity::Scene;

FileScene read_by_extension(const std::filesystem::path& path, MeshMaterials materials,
                            const Progress& progress) {
  const std::string extension = lower_case_extension(path);
  if (extension == ".idf" || extension == ".epjson") return read_energyplus(path, progress);
  if (extension == ".foam") return read_foam_case(path);
  if (extension == ".obj") return read_obj(path, materials, progress);
  if (extension == ".msh") return read_msh(path, progress);
  if (extension == ".off") return read_off(path, progress);
  if (extension == ".ply") return read_ply(path, progress);
  if (extension == ".stl") return read_stl(path, progress);
  if (extension == ".vs3") return read_vs3(path, progress);
  if (extension == ".vtk" || extension == ".vtp" || extension == ".vtu") {
    if (radiosity_io_read_vtk_mesh == nullptr) {
      fail(path, "this program was built without VTK, which " + extension + " files need");
    }
    FileScene file;
    radiosity_io_read_vtk_mesh(path, file);
    return file;
  }
  if (extension == ".gltf" || extension == ".glb") {
    FileScene file = read_gltf(path, progress);
    file.scene.files = gltf_files(path);
    return file;
  }
  fail(path, fmt::format("unknown extension \"{}\", expected .obj, .off, .ply, .stl, .gltf, "
                         ".glb, .msh, .vs3, .vtk, .vtp, .vtu, .idf, .epJSON, .foam or .json",
                         extension));
}

/// Coordinates of glTF are single or integers, whatever its transforms make of them.
void find_precision(const std::filesystem::path& path, Scene& mesh) {
  const std::string extension = lower_case_extension(path);
  const bool is_single = extension == ".gltf" || extension == ".glb";
  const Rounding rounding =
      is_single ? single_rounding(mesh.vertices, mesh.precision) : found_rounding(mesh.vertices);
  mesh.precision = rounding.precision;
  if (const auto warning = rounding_warning(rounding)) {
    mesh.warnings.push_back(path.string() + ": " + *warning);
  }
}

}  // namespace

FileScene read_mesh(const std::filesystem::path& path, MeshMaterials materials,
                    const Progress& progress) {
  FileScene file = read_by_extension(path, materials, progress);
  Scene& mesh = file.scene;
  if (mesh.n_polygons() == 0) fail(path, "has no polygons");
  constexpr std::size_t kMax = std::numeric_limits<std::int32_t>::max();
  if (mesh.vertices.size() > kMax || mesh.polygon_surface.size() > kMax) {
    fail(path, fmt::format("has {} vertices and {} polygons, expected at most {} of each",
                           mesh.vertices.size(), mesh.polygon_surface.size(), kMax));
  }
  find_precision(path, mesh);
  return file;
}

}  // namespace io
