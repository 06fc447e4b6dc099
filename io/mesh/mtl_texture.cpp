#include "io/mesh/mtl_texture.h"

#include <algorithm>
#include <array>

#include "io/base/line_reader.h"

namespace io {
namespace {

/// Options with as many words behind them.
struct MapOption {
  std::string_view name;
  int n_words;
  bool changes_picture;
};
constexpr std::array<MapOption, 8> kMapOptions = {{{"-blendu", 1, false},
                                                   {"-blendv", 1, false},
                                                   {"-boost", 1, false},
                                                   {"-texres", 1, false},
                                                   {"-bm", 1, false},
                                                   {"-cc", 1, true},
                                                   {"-imfchan", 1, true},
                                                   {"-mm", 2, true}}};

/// Up to three numbers, of which the first two count; what stands behind them stays.
void read_numbers(Words& words, Eigen::Vector2d& values) {
  for (int k = 0; k < 3; ++k) {
    Words ahead = words;
    const auto number = parse_number<double>(ahead.next());
    if (!number) return;
    words = ahead;
    if (k < 2) values[k] = *number;
  }
}

}  // namespace

MtlTexture read_mtl_texture(std::string_view text) {
  MtlTexture texture;
  Words words(text);
  for (;;) {
    Words ahead = words;
    const std::string_view option = ahead.next();
    const auto* const known =
        std::find_if(kMapOptions.begin(), kMapOptions.end(),
                     [&](const MapOption& one) { return one.name == option; });
    if (option == "-s") {
      read_numbers(ahead, texture.scale);
    } else if (option == "-o") {
      read_numbers(ahead, texture.offset);
    } else if (option == "-t") {
      Eigen::Vector2d turbulence = Eigen::Vector2d::Zero();
      read_numbers(ahead, turbulence);
      if (!turbulence.isZero(0)) texture.has_other_options = true;
    } else if (option == "-clamp") {
      if (ahead.next() == "on") texture.wrap = radiosity::TextureWrap::clamp;
    } else if (known != kMapOptions.end()) {
      for (int k = 0; k < known->n_words; ++k) ahead.next();
      if (known->changes_picture) texture.has_other_options = true;
    } else {
      break;
    }
    words = ahead;
  }
  texture.file = std::string(words.rest());
  if (!texture.scale.allFinite() || !texture.offset.allFinite()) texture.file.clear();
  return texture;
}

std::optional<std::filesystem::path> find_beside(const std::filesystem::path& file,
                                                 std::string name) {
  std::error_code ignored;
  for (int k = 0; k < 2 && !name.empty(); ++k) {
    std::filesystem::path path = file.parent_path() / name;
    if (std::filesystem::exists(path, ignored)) return path;
    std::replace(name.begin(), name.end(), '\\', '/');
  }
  return std::nullopt;
}

}  // namespace io
