#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <string_view>

#include "radiosity/base/progress.h"
#include "radiosity/scene/texture.h"

namespace io {

/// Pictures of textures, each file read once. All together have at most so many texels, 4 bytes
/// each.
class TexturePictures {
 public:
  static constexpr std::size_t kMostTexels = std::size_t{1} << 27U;

  /// The picture of a file. Throws SceneError: "wood.png: is a damaged PNG: ..."
  std::shared_ptr<const radiosity::TextureImage> read(const std::filesystem::path& path,
                                                      const radiosity::Progress& progress);

  /// Of a picture that stands within another file. Throws SceneError that does not name it.
  std::shared_ptr<const radiosity::TextureImage> decode(std::string_view bytes);

 private:
  std::map<std::filesystem::path, std::shared_ptr<const radiosity::TextureImage>> known_;
  std::size_t left_ = kMostTexels;
};

}  // namespace io
