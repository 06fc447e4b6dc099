#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>

#include "radiosity/scene/patch_mesh.h"
#include "radiosity/scene/scene.h"
#include "radiosity/scene/texture.h"

namespace radiosity {

/// Reflectance of a patch whose material has a texture: its mean over the patch. Texture
/// coordinates are linear in place where those of the polygon's corners are, within 1e-6 of their
/// span; else within each of the triangles from its first corner, or, of polygons that are not
/// convex, by least squares. Of a polygon without coordinates that of the whole picture.
TextureMean patch_texture(const Scene& scene, const PatchMesh& mesh, Index patch,
                          const Texture& texture);

/// The same of a whole polygon of the scene.
TextureMean polygon_texture(const Scene& scene, Index polygon, const Texture& texture);

/// Reflectance of a material with a texture, all bands: the mean over its polygons by their area;
/// of the whole picture if it has none.
Eigen::VectorXd mean_of_texture(const Scene& scene, int material);

/// Standard deviation of the reflectance within each patch, the bands' root mean square; 0 where
/// the material has no texture. Empty if none has.
Eigen::VectorXd texture_deviation(const Scene& scene, const PatchMesh& mesh);

/// Whether any material of the scene has a texture.
bool has_textures(const Scene& scene);

/// Reflectances from place to place of the patches that have a texture. Immutable; copies share
/// what they hold. May be used by many threads.
class TextureMap {
 public:
  /// Of nothing.
  TextureMap() = default;
  TextureMap(const Scene& scene, const PatchMesh& mesh);

  [[nodiscard]] bool is_empty() const { return !polygons_; }
  /// What a patch reflects at a point of it, m, linear RGB: the value of the texel there. Empty
  /// where it has no texture or its corners no texture coordinates, so that it reflects its mean
  /// all over, and of images of a symmetric part.
  [[nodiscard]] std::optional<Eigen::Array3d> at(Index patch, const Vec3& point) const;

 private:
  struct Polygons;
  std::shared_ptr<const Polygons> polygons_;
};

}  // namespace radiosity
