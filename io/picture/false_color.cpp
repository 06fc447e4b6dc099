#include "io/picture/false_color.h"

#include <cassert>
#include <cmath>

#include "io/base/extension.h"
#include "io/picture/color_bar.h"
#include "io/picture/image_file.h"

namespace io {
namespace {

using radiosity::Image;
using radiosity::Index;

constexpr Rgb kNothing = {200, 200, 200};

/// What each pixel that sees something shows: its value without the share that sees nothing.
Eigen::VectorXd seen_values(const Image& image) {
  std::vector<double> seen;
  for (Index i = 0; i < image.values.rows(); ++i) {
    if (image.alpha[i] > 0) seen.push_back(image.values(i, 0) / image.alpha[i]);
  }
  return Eigen::Map<const Eigen::VectorXd>(seen.data(), static_cast<Index>(seen.size()));
}

RgbPicture colored(const Image& image, const ColorScale& scale, ColorMap map) {
  RgbPicture picture = {image.width, image.height, {}};
  picture.bytes.reserve(3 * image.alpha.size());
  for (Index i = 0; i < image.values.rows(); ++i) {
    const double alpha = image.alpha[i];
    const Rgb color =
        alpha > 0 ? map_color(position_on(scale, image.values(i, 0) / alpha), map) : kNothing;
    for (std::size_t c = 0; c < 3; ++c) {
      const double blended = alpha * color[c] + (1 - alpha) * kNothing[c];
      picture.bytes.push_back(static_cast<std::uint8_t>(std::lround(blended)));
    }
  }
  return picture;
}

}  // namespace

ColorScale write_false_color(const std::filesystem::path& path, const Image& image,
                             const FalseColorOptions& options) {
  assert(image.values.cols() == 1);
  const Eigen::VectorXd seen = seen_values(image);
  const ScaleChoice choice = {.is_symmetric = options.map == ColorMap::diverging};
  const ColorScale scale = options.scale.value_or(fitting_scale(seen, options.logarithmic, choice));
  if (lower_case_extension(path) != ".png") {
    write_image(path, image, {.channel = options.channel});
    return scale;
  }
  const ColorBar bar = {.scale = scale,
                        .map = options.map,
                        .title = options.title,
                        .has_below = (seen.array() < scale.low).any(),
                        .has_above = (seen.array() > scale.high).any()};
  write_png(path, add_color_bar(colored(image, scale, options.map), bar));
  return scale;
}

}  // namespace io
