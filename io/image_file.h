#pragma once

#include <filesystem>
#include <optional>

#include "radiosity/render.h"
#include "radiosity/scene.h"

namespace io {

struct ImageOptions {
  /// Factor from radiance to display value for .png; absent: chosen so that the picture is well
  /// exposed. An .exr is linear radiance and ignores it.
  std::optional<double> exposure;
};

/// Writes a picture by extension: .png (8-bit sRGB) or .exr (float, linear, all bands). One band
/// shows as grey, three as linear RGB. Written beside and renamed into place. Throws OutputError.
void write_image(const std::filesystem::path& path, const radiosity::Image& image,
                 const ImageOptions& options = {});

}  // namespace io
