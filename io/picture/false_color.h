#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "io/picture/color_map.h"
#include "radiosity/picture/render.h"

namespace io {

struct FalseColorOptions {
  std::vector<std::string> title = {};   ///< lines above the bar: name, unit...
  std::string channel = "Y";             ///< name of an .exr's only channel
  std::optional<ColorScale> scale = {};  ///< absent: the one that fits what is seen
  bool logarithmic = false;              ///< of the scale that is found
  /// A diverging one makes the scale that is found symmetric about 0, if values are below.
  ColorMap map = ColorMap::viridis;
};

/// Writes a picture of one band: a .png in false colours with a labelled bar added at its right
/// (`add_color_bar`), grey where nothing is seen; an .exr has the values themselves and no bar.
/// Returns the scale. Throws OutputError.
ColorScale write_false_color(const std::filesystem::path& path, const radiosity::Image& image,
                             const FalseColorOptions& options = {});

}  // namespace io
