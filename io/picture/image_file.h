#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "io/picture/rgb_picture.h"
#include "radiosity/picture/render.h"
#include "radiosity/scene/scene.h"

namespace io {

struct ImageOptions {
  /// Factor from radiance to display value for .png; absent: chosen so that the picture is well
  /// exposed. An .exr is linear radiance and ignores it.
  std::optional<double> exposure = {};
  /// Wavelengths of the picture's bands, nm, increasing; a .png then shows their colour. Empty:
  /// three bands are linear RGB, any other number shows as grey.
  std::vector<double> wavelengths = {};
  /// Name of the channel of an .exr with one band. With several they are R, G, B or band.0...
  std::string channel = "Y";
};

/// A picture as a .png shows it: 8-bit sRGB, colours by `display_colors`, exposed as the options
/// say.
RgbPicture srgb_picture(const radiosity::Image& image, const ImageOptions& options = {});

/// Writes a picture by extension: .png (`srgb_picture`) or .exr (float, linear, all bands as they
/// are). Written beside and renamed into place. Throws OutputError.
void write_image(const std::filesystem::path& path, const radiosity::Image& image,
                 const ImageOptions& options = {});

/// The bytes of a PNG file with these pixels. Throws OutputError naming `path`.
std::vector<std::uint8_t> encode_png(const std::filesystem::path& path, const RgbPicture& picture);

/// Writes pixels as they are. Beside and renamed into place, too. Throws OutputError.
void write_png(const std::filesystem::path& path, const RgbPicture& picture);

}  // namespace io
