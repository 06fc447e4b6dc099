#include "io/picture/texture_pictures.h"

#include <fmt/format.h>

#include <cstdint>
#include <utility>

#include "io/base/byte_reader.h"
#include "io/base/line_reader.h"
#include "io/picture/decode_picture.h"
#include "radiosity/base/error.h"

namespace io {

using radiosity::TextureImage;

std::shared_ptr<const TextureImage> TexturePictures::decode(std::string_view bytes) {
  RgbPicture picture = decode_picture(bytes, left_);
  left_ -= static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height);
  return std::make_shared<const TextureImage>(picture.width, picture.height,
                                              std::move(picture.bytes));
}

std::shared_ptr<const TextureImage> TexturePictures::read(const std::filesystem::path& path,
                                                          const radiosity::Progress& progress) {
  std::error_code ignored;
  const std::filesystem::path key = std::filesystem::weakly_canonical(path, ignored);
  if (const auto known = known_.find(key); known != known_.end()) return known->second;
  constexpr std::uint64_t kMostBytes = 4 * kMostTexels;
  ByteReader bytes(path, 0, progress);
  if (bytes.size() > kMostBytes) {
    fail(path, fmt::format("has {} bytes, more than the {} that are read of a picture",
                           bytes.size(), kMostBytes));
  }
  const char* first = bytes.take(bytes.size());
  try {
    return known_.emplace(key, decode({first, bytes.size()})).first->second;
  } catch (const radiosity::SceneError& error) {
    fail(path, error.what());
  }
}

}  // namespace io
