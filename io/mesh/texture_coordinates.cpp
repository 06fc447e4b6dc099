#include "io/mesh/texture_coordinates.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <span>

#include "io/base/printable.h"
#include "io/mesh/file_scene.h"
#include "radiosity/scene/patch_texture.h"

namespace io {
namespace {

using Eigen::Vector2d;
using radiosity::Index;
using radiosity::Scene;

const Vector2d kNoPlace = Vector2d::Constant(std::numeric_limits<double>::quiet_NaN());

/// Length of an outline in texels, and how far it is from those of the picture; not finite where a
/// coordinate is missing.
double span_of(std::span<const Vector2d> outline, const radiosity::TextureImage& image) {
  const Vector2d size(image.width(), image.height());
  double sum = outline[0].cwiseProduct(size).lpNorm<1>();
  for (std::size_t k = 0; k < outline.size(); ++k) {
    sum += (outline[(k + 1) % outline.size()] - outline[k]).cwiseProduct(size).lpNorm<1>();
  }
  return sum;
}

}  // namespace

void check_texture_coordinates(const std::filesystem::path& path, Scene& scene,
                               std::vector<std::string>& repairs) {
  if (!has_textures(scene)) {
    scene.texture_coordinates.clear();
    return;
  }
  RepairCount missing;
  RepairCount wide;
  scene.texture_coordinates.resize(scene.corners.size(), kNoPlace);
  for (Index i = 0; i < scene.n_polygons(); ++i) {
    const int material = scene.surfaces[scene.polygon_surface[i]].material;
    if (material < 0 || !scene.materials[material].texture || scene.polygon(i).empty()) continue;
    const std::span<Vector2d> outline =
        std::span(scene.texture_coordinates)
            .subspan(static_cast<std::size_t>(scene.first_corner[i]), scene.polygon(i).size());
    const double span = span_of(outline, *scene.materials[material].texture->image);
    if (span <= radiosity::kMostTexels) continue;
    const std::string who =
        fmt::format("polygon {}, of material {},", i, in_quotes(scene.materials[material].name));
    if (std::isfinite(span)) {
      wide.add(path.string(),
               fmt::format("{} has texture coordinates over {:.2g} texels, more than {:.0e}", who,
                           span, radiosity::kMostTexels));
    } else {
      missing.add(path.string(), who + " has no texture coordinates at some of its corners");
    }
    for (Vector2d& coordinate : outline) coordinate = kNoPlace;
  }
  missing.report("it has the mean of the picture", repairs);
  wide.report("it has the mean of the picture", repairs);
}

void append_texture_coordinates(const Scene& mesh, Index i, bool is_reversed, Scene& scene) {
  if (mesh.texture_coordinates.empty()) return;
  const auto given =
      std::span(mesh.texture_coordinates)
          .subspan(static_cast<std::size_t>(mesh.first_corner[i]), mesh.polygon(i).size());
  std::vector<Vector2d>& all = scene.texture_coordinates;
  all.resize(scene.corners.size() - given.size(), kNoPlace);
  if (is_reversed) {
    all.insert(all.end(), given.rbegin(), given.rend());
  } else {
    all.insert(all.end(), given.begin(), given.end());
  }
}

void pad_texture_coordinates(Scene& scene) {
  if (scene.texture_coordinates.empty()) return;
  scene.texture_coordinates.resize(scene.corners.size(), kNoPlace);
}

}  // namespace io
