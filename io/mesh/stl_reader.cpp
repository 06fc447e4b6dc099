#include "io/mesh/stl_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/base/byte_reader.h"
#include "io/base/line_reader.h"
#include "io/mesh/surface_index.h"
#include "io/mesh/vertex_merger.h"

namespace io {
namespace {

using radiosity::Progress;
using radiosity::Scene;
using radiosity::Vec3;

constexpr std::uint64_t kHeaderSize = 84;  // 80 bytes of comment and the number of triangles
constexpr std::uint64_t kFacetSize = 50;   // normal, three vertices, two bytes of attributes

enum class Variant { ascii, binary };

/// Binary files may start with "solid" too, so their size decides; and if that does not fit, a
/// zero byte near the start, which no text has. Text may start with blank lines.
Variant variant(const std::filesystem::path& path, const Progress& progress) {
  ByteReader bytes(path, 0, progress);
  if (bytes.size() >= kHeaderSize) {
    const auto n_facets = load<std::uint32_t>(bytes.take(kHeaderSize) + 80, std::endian::little);
    if (bytes.size() == kHeaderSize + kFacetSize * n_facets) return Variant::binary;
  }
  ByteReader start(path, 0, progress);
  const auto n = std::min<std::uint64_t>(start.size(), 512);
  std::string_view text(start.take(n), n);
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n\v\f"), text.size()));
  const bool is_text = text.find('\0') == std::string_view::npos;
  std::string first(Words(text.substr(0, text.find('\n'))).next());
  std::transform(first.begin(), first.end(), first.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return is_text && first == "solid" ? Variant::ascii : Variant::binary;
}

FileScene read_binary(const std::filesystem::path& path, const Progress& progress) {
  ByteReader bytes(path, 0, progress);
  if (bytes.size() < kHeaderSize) {
    fail(path, fmt::format("is no STL file: found {} bytes, expected \"solid\" or a binary header "
                           "of {} bytes",
                           bytes.size(), kHeaderSize));
  }
  const auto n_facets = load<std::uint32_t>(bytes.take(kHeaderSize) + 80, std::endian::little);
  const std::uint64_t expected = kHeaderSize + kFacetSize * n_facets;
  if (bytes.size() < expected) {
    fail(path, fmt::format("is truncated: found {} bytes, expected {} for {} triangles",
                           bytes.size(), expected, n_facets));
  }
  FileScene result;
  Scene& scene = result.scene;
  if (bytes.size() > expected) {
    result.repairs.push_back(fmt::format("{}: {} bytes after the last of {} facets are ignored",
                                         path.string(), bytes.size() - expected, n_facets));
  }
  scene.surfaces.push_back({.name = path.stem().string(), .material = -1, .two_sided = false});
  scene.corners.reserve(3 * std::size_t{n_facets});
  VertexMerger merger;
  for (std::uint32_t i = 0; i < n_facets; ++i) {
    const char* facet = bytes.take(kFacetSize);
    std::array<std::int32_t, 3> corners;
    for (int k = 0; k < 3; ++k) {
      Vec3 point;
      for (int axis = 0; axis < 3; ++axis) {
        point[axis] = load<float>(facet + 12 * (k + 1) + 4 * axis, std::endian::little);
      }
      if (!point.allFinite()) fail(path, fmt::format("triangle {}: coordinate is not finite", i));
      corners[k] = merger.find_or_add(point, scene.vertices);
    }
    scene.add_polygon(corners, 0);
  }
  return result;
}

class AsciiStl {
 public:
  AsciiStl(const std::filesystem::path& path, const Progress& progress)
      : lines_(path, progress), surfaces_(scene_, path.stem().string()) {}

  FileScene read() {
    bool in_solid = false;
    while (next_keyword()) {
      if (keyword_ == "solid" && !in_solid) {
        surface_ = surfaces_.find_or_add(std::string(words_.rest()), -1);
        in_solid = true;
        lines_.recognise();
      } else if (keyword_ == "facet" && in_solid) {
        read_facet();
      } else if (keyword_ == "endsolid" && in_solid) {
        in_solid = false;
      } else {
        lines_.fail(fmt::format("expected {}, found {}",
                                in_solid ? "\"facet\" or \"endsolid\"" : "\"solid\"",
                                lines_.shown(keyword_)));
      }
    }
    if (in_solid) lines_.fail("file ends before \"endsolid\"");
    return {std::move(scene_), {}};
  }

 private:
  /// Goes to the next line that is not blank and takes its first word, in lower case.
  bool next_keyword() {
    do {
      if (!lines_.next_line()) return false;
      words_ = Words(lines_.line());
      keyword_ = words_.next();
    } while (keyword_.empty());
    for (char& c : keyword_) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return true;
  }

  void expect(std::string_view keyword) {
    if (!next_keyword()) lines_.fail(fmt::format("file ends before \"{}\"", keyword));
    if (keyword_ != keyword) {
      lines_.fail(fmt::format("expected \"{}\", found {}", keyword, lines_.shown(keyword_)));
    }
  }

  void read_facet() {
    expect("outer");
    std::array<std::int32_t, 3> corners;
    for (std::int32_t& corner : corners) {
      expect("vertex");
      corner = merger_.find_or_add(lines_.point(words_), scene_.vertices);
    }
    expect("endloop");
    expect("endfacet");
    scene_.add_polygon(corners, surface_);
  }

  LineReader lines_;
  Scene scene_;
  SurfaceIndex surfaces_;
  VertexMerger merger_;
  Words words_{""};
  std::string keyword_;
  std::int32_t surface_ = 0;
};

}  // namespace

FileScene read_stl(const std::filesystem::path& path, const Progress& progress) {
  if (variant(path, progress) == Variant::binary) return read_binary(path, progress);
  return AsciiStl(path, progress).read();
}

}  // namespace io
