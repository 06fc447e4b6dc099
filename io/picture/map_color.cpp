#include "io/picture/map_color.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace io {
namespace {

using Row = std::array<double, 3>;

// Every fifteenth of the 256 colours; linear between them, which is within about 5 of 255 (of
// cividis 11).
constexpr std::array<Row, 18> kViridis = {{{0.2670, 0.0049, 0.3294},
                                           {0.2819, 0.0897, 0.4124},
                                           {0.2803, 0.1657, 0.4765},
                                           {0.2637, 0.2376, 0.5188},
                                           {0.2374, 0.3052, 0.5419},
                                           {0.2086, 0.3678, 0.5527},
                                           {0.1823, 0.4262, 0.5571},
                                           {0.1592, 0.4822, 0.5581},
                                           {0.1378, 0.5375, 0.5549},
                                           {0.1211, 0.5927, 0.5446},
                                           {0.1281, 0.6477, 0.5235},
                                           {0.1807, 0.7014, 0.4882},
                                           {0.2741, 0.7520, 0.4366},
                                           {0.3952, 0.7975, 0.3678},
                                           {0.5356, 0.8358, 0.2819},
                                           {0.6889, 0.8654, 0.1827},
                                           {0.8456, 0.8873, 0.0997},
                                           {0.9932, 0.9062, 0.1439}}};
constexpr std::array<Row, 18> kInferno = {{{0.0015, 0.0005, 0.0139},
                                           {0.0377, 0.0259, 0.1322},
                                           {0.1167, 0.0476, 0.2723},
                                           {0.2179, 0.0366, 0.3835},
                                           {0.3163, 0.0535, 0.4251},
                                           {0.4101, 0.0879, 0.4331},
                                           {0.5035, 0.1216, 0.4234},
                                           {0.5969, 0.1548, 0.3981},
                                           {0.6887, 0.1922, 0.3576},
                                           {0.7751, 0.2397, 0.3035},
                                           {0.8514, 0.3023, 0.2396},
                                           {0.9130, 0.3816, 0.1698},
                                           {0.9569, 0.4754, 0.0947},
                                           {0.9819, 0.5794, 0.0262},
                                           {0.9875, 0.6904, 0.0800},
                                           {0.9731, 0.8054, 0.2169},
                                           {0.9476, 0.9174, 0.4107},
                                           {0.9884, 0.9984, 0.6449}}};
constexpr std::array<Row, 18> kCividis = {{{0.0000, 0.1351, 0.3048},
                                           {0.0000, 0.1761, 0.4076},
                                           {0.0875, 0.2149, 0.4373},
                                           {0.1805, 0.2562, 0.4273},
                                           {0.2476, 0.2970, 0.4229},
                                           {0.3059, 0.3377, 0.4245},
                                           {0.3599, 0.3786, 0.4315},
                                           {0.4116, 0.4201, 0.4436},
                                           {0.4616, 0.4624, 0.4620},
                                           {0.5142, 0.5055, 0.4726},
                                           {0.5706, 0.5497, 0.4696},
                                           {0.6286, 0.5951, 0.4596},
                                           {0.6880, 0.6420, 0.4429},
                                           {0.7488, 0.6905, 0.4184},
                                           {0.8111, 0.7408, 0.3852},
                                           {0.8751, 0.7931, 0.3397},
                                           {0.9411, 0.8475, 0.2758},
                                           {0.9957, 0.9093, 0.2178}}};
// Interpolated in Msh with white in the middle, then linear between these.
constexpr std::array<Row, 17> kDiverging = {{{0.2314, 0.2980, 0.7529},
                                             {0.3050, 0.4060, 0.8444},
                                             {0.3838, 0.5089, 0.9169},
                                             {0.4672, 0.6042, 0.9679},
                                             {0.5533, 0.6886, 0.9952},
                                             {0.6394, 0.7594, 0.9981},
                                             {0.7223, 0.8138, 0.9765},
                                             {0.7987, 0.8497, 0.9317},
                                             {0.8654, 0.8654, 0.8654},
                                             {0.9243, 0.8274, 0.7746},
                                             {0.9591, 0.7699, 0.6781},
                                             {0.9703, 0.6945, 0.5794},
                                             {0.9583, 0.6031, 0.4817},
                                             {0.9243, 0.4976, 0.3876},
                                             {0.8695, 0.3786, 0.2997},
                                             {0.7959, 0.2415, 0.2196},
                                             {0.7059, 0.0157, 0.1490}}};
constexpr std::array<Row, 2> kGrey = {{{0.04, 0.04, 0.04}, {1, 1, 1}}};

struct Named {
  std::string_view name;
  std::span<const Row> rows;
};

/// In the order of the enumeration.
constexpr std::array<Named, 5> kNamed = {{{"viridis", kViridis},
                                          {"inferno", kInferno},
                                          {"cividis", kCividis},
                                          {"grey", kGrey},
                                          {"diverging", kDiverging}}};

constexpr std::array kMaps = {ColorMap::viridis, ColorMap::inferno, ColorMap::cividis,
                              ColorMap::grey, ColorMap::diverging};

const Named& named(ColorMap map) { return kNamed[static_cast<std::size_t>(map)]; }

}  // namespace

std::span<const ColorMap> color_maps() { return kMaps; }

std::string_view color_map_name(ColorMap map) { return named(map).name; }

std::optional<ColorMap> color_map_named(std::string_view name) {
  if (name == "gray") return ColorMap::grey;
  for (const ColorMap map : kMaps) {
    if (color_map_name(map) == name) return map;
  }
  return std::nullopt;
}

Rgb map_color(double position, ColorMap map) {
  const std::span<const Row> rows = named(map).rows;
  const double place = std::clamp(position, 0.0, 1.0) * static_cast<double>(rows.size() - 1);
  const auto k = std::min(static_cast<std::size_t>(place), rows.size() - 2);
  const double t = place - static_cast<double>(k);
  Rgb color{};
  for (std::size_t c = 0; c < 3; ++c) {
    const double value = (1 - t) * rows[k][c] + t * rows[k + 1][c];
    color[c] = static_cast<std::uint8_t>(std::lround(255 * value));
  }
  return color;
}

}  // namespace io
