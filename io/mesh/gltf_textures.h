#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <map>
#include <memory>

#include "io/mesh/gltf_document.h"
#include "io/picture/texture_pictures.h"
#include "radiosity/scene/scene.h"

namespace io {

/// Which of a primitive's texture coordinates a material uses, and how they are moved.
struct GltfPlacement {
  std::int64_t set = 0;                                     ///< n of TEXCOORD_n
  Eigen::Affine2d transform = Eigen::Affine2d::Identity();  ///< KHR_texture_transform
};

/// The textures of a glTF file, each of whose pictures is read once.
class GltfTextures {
 public:
  /// The document must outlive this.
  explicit GltfTextures(GltfDocument& document) : document_(document) {}

  /// Gives the material the texture that "baseColorTexture" or the like refers to, times its
  /// reflectance. Throws SceneError if there is none that can be read, and leaves it as it is then.
  GltfPlacement read(const JsonItem& texture_info, radiosity::Material& material);

 private:
  std::shared_ptr<const radiosity::TextureImage> picture(const JsonItem& index);

  GltfDocument& document_;
  TexturePictures pictures_;
  std::map<std::size_t, std::shared_ptr<const radiosity::TextureImage>> read_;  // by image
};

}  // namespace io
