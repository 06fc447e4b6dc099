#include "io/mesh/foam_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "io/base/line_reader.h"
#include "io/mesh/foam_file.h"

namespace io {
namespace {

using radiosity::Index;
using radiosity::Scene;
using radiosity::Vec3;

std::vector<Vec3> read_points(const std::filesystem::path& path) {
  FoamTokens tokens(path);
  const Index n = tokens.count();
  tokens.expect("(");
  std::vector<Vec3> points;
  for (Index i = 0; i < n; ++i) {
    tokens.expect("(");
    Vec3 point;
    for (double& coordinate : point) coordinate = tokens.number();
    points.push_back(point);
    tokens.expect(")");
  }
  tokens.expect(")");
  return points;
}

/// The corners of each face, as indices below n_points.
std::vector<std::vector<std::int32_t>> read_faces(const std::filesystem::path& path,
                                                  std::size_t n_points) {
  FoamTokens tokens(path);
  const Index n = tokens.count();
  tokens.expect("(");
  std::vector<std::vector<std::int32_t>> faces(static_cast<std::size_t>(n));
  for (auto& face : faces) {
    const Index n_corners = tokens.count();
    if (n_corners < 3) tokens.fail("a face has fewer than three corners");
    tokens.expect("(");
    for (Index k = 0; k < n_corners; ++k) {
      const Index corner = tokens.whole();
      if (corner >= static_cast<Index>(n_points)) {
        tokens.fail(fmt::format("a face uses point {}, but there are {}", corner, n_points));
      }
      face.push_back(static_cast<std::int32_t>(corner));
    }
    tokens.expect(")");
  }
  tokens.expect(")");
  return faces;
}

}  // namespace

FileScene read_foam_case(const std::filesystem::path& path) {
  if (!std::filesystem::exists(path)) fail(path, "there is no such file");
  const std::filesystem::path folder = path.parent_path() / "constant" / "polyMesh";
  FileScene file;
  Scene& scene = file.scene;
  scene.bands = {.kind = radiosity::Bands::Kind::grey, .wavelengths = {}};
  for (const char* part : {"boundary", "points", "faces"}) scene.files.push_back(folder / part);
  const std::vector<FoamPatch> patches = read_radiating_patches(folder / "boundary");
  const std::vector<Vec3> points = read_points(folder / "points");
  const auto faces = read_faces(folder / "faces", points.size());
  std::vector<std::int32_t> vertex_of(points.size(), -1);  // of the boundary only
  for (const FoamPatch& patch : patches) {
    if (patch.first + patch.n > std::ssize(faces)) {
      fail(folder / "boundary", fmt::format("patch {} has faces up to {}, but there are {}",
                                            patch.name, patch.first + patch.n, faces.size()));
    }
    const auto surface = static_cast<std::int32_t>(scene.surfaces.size());
    scene.surfaces.push_back({.name = patch.name, .material = -1});
    for (Index f = patch.first; f < patch.first + patch.n; ++f) {
      // There they run as seen from outside.
      std::vector<std::int32_t> corners(faces[static_cast<std::size_t>(f)].rbegin(),
                                        faces[static_cast<std::size_t>(f)].rend());
      for (std::int32_t& corner : corners) {
        std::int32_t& vertex = vertex_of[static_cast<std::size_t>(corner)];
        if (vertex < 0) {
          vertex = static_cast<std::int32_t>(scene.vertices.size());
          scene.vertices.push_back(points[static_cast<std::size_t>(corner)]);
        }
        corner = vertex;
      }
      scene.add_polygon(corners, surface);
    }
  }
  return file;
}

}  // namespace io
