#include "io/picture/decode_picture.h"

#include <fmt/format.h>
#include <png.h>

#include <cstdint>
#include <utility>
#include <vector>

#include "io/picture/decode_jpeg.h"
#include "radiosity/base/error.h"

namespace io {
namespace {

using radiosity::SceneError;

/// What libpng keeps of a picture being read.
class PngInput {
 public:
  explicit PngInput(std::string_view file) {
    header_.version = PNG_IMAGE_VERSION;
    if (png_image_begin_read_from_memory(&header_, file.data(), file.size()) == 0) fail();
    header_.flags |= PNG_IMAGE_FLAG_16BIT_sRGB;  // unless the file says otherwise
  }
  PngInput(const PngInput&) = delete;
  PngInput& operator=(const PngInput&) = delete;
  ~PngInput() { png_image_free(&header_); }

  [[nodiscard]] std::size_t width() const { return header_.width; }
  [[nodiscard]] std::size_t height() const { return header_.height; }

  RgbPicture read() {
    const bool is_transparent = (header_.format & PNG_FORMAT_FLAG_ALPHA) != 0;
    header_.format = is_transparent ? PNG_FORMAT_RGBA : PNG_FORMAT_RGB;
    const std::size_t n_channels = is_transparent ? 4 : 3;
    std::vector<std::uint8_t> bytes(n_channels * width() * height());
    if (png_image_finish_read(&header_, nullptr, bytes.data(), 0, nullptr) == 0) fail();
    if (is_transparent) {
      std::size_t to = 0;
      for (std::size_t from = 0; from < bytes.size(); from += n_channels) {
        for (std::size_t k = 0; k < 3; ++k) bytes[to++] = bytes[from + k];
      }
      bytes.resize(to);
    }
    return {static_cast<int>(width()), static_cast<int>(height()), std::move(bytes)};
  }

 private:
  [[noreturn]] void fail() const {
    throw SceneError(
        fmt::format("is a damaged PNG: {}", static_cast<const char*>(header_.message)));
  }

  png_image header_ = {};
};

}  // namespace

void check_picture_size(std::size_t width, std::size_t height, std::size_t most_pixels) {
  if (width > 0 && height <= most_pixels / width) return;
  throw SceneError(fmt::format("has {} x {} pixels, more than the {} that are read", width, height,
                               most_pixels));
}

RgbPicture decode_picture(std::string_view file, std::size_t most_pixels) {
  if (file.starts_with("\x89PNG")) {
    PngInput input(file);
    check_picture_size(input.width(), input.height(), most_pixels);
    return input.read();
  }
  if (file.starts_with("\xff\xd8")) return decode_jpeg(file, most_pixels);
  throw SceneError("is neither PNG nor JPEG");
}

}  // namespace io
