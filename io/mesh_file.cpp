#include "io/mesh_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <limits>

#include "io/gltf_files.h"
#include "io/gltf_reader.h"
#include "io/line_reader.h"
#include "io/obj_reader.h"
#include "io/off_reader.h"
#include "io/ply_reader.h"
#include "io/rounding.h"
#include "io/stl_reader.h"

namespace io {
namespace {

using radiosity::Progress;
using radiosity::Scene;

FileScene read_by_extension(const std::filesystem::path& path, MeshMaterials materials,
                            const Progress& progress) {
  const std::string extension = lower_extension(path);
  if (extension == ".obj") return read_obj(path, materials, progress);
  if (extension == ".off") return read_off(path, progress);
  if (extension == ".ply") return read_ply(path, progress);
  if (extension == ".stl") return read_stl(path, progress);
  if (extension == ".gltf" || extension == ".glb") {
    FileScene file = read_gltf(path, progress);
    file.scene.files = gltf_files(path);
    return file;
  }
  fail(path, fmt::format("unknown extension \"{}\", expected .obj, .off, .ply, .stl, .gltf, .glb "
                         "or .json",
                         extension));
}

/// Coordinates of glTF are single or integers, whatever its transforms make of them.
void find_precision(const std::filesystem::path& path, Scene& mesh) {
  const std::string extension = lower_extension(path);
  const bool is_single = extension == ".gltf" || extension == ".glb";
  const Rounding rounding =
      is_single ? single_rounding(mesh.vertices, mesh.precision) : found_rounding(mesh.vertices);
  mesh.precision = rounding.precision;
  if (const auto warning = rounding_warning(rounding)) {
    mesh.warnings.push_back(path.string() + ": " + *warning);
  }
}

}  // namespace

std::string lower_extension(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

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
