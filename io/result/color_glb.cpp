#include "io/result/color_glb.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "io/base/atomic_file.h"
#include "io/base/printable.h"
#include "io/result/colored_mesh.h"
#include "radiosity/base/error.h"

namespace io {
namespace {

using Json = nlohmann::ordered_json;
using radiosity::Index;
using radiosity::PatchMesh;

// Names that glTF gives to numbers.
constexpr int kUnsignedShort = 5123;
constexpr int kUnsignedInt = 5125;
constexpr int kFloat = 5126;
constexpr int kVertexBuffer = 34962;
constexpr int kIndexBuffer = 34963;
constexpr std::uint32_t kMagic = 0x46546C67;  // "glTF"
constexpr std::uint32_t kJsonChunk = 0x4E4F534A;
constexpr std::uint32_t kBinaryChunk = 0x004E4942;

/// Bytes of a vertex: three floats, and three shorts that a fourth fills up to a multiple of 4.
constexpr std::size_t kPlaceBytes = 12;
constexpr std::size_t kColorBytes = 8;

using Place = std::array<float, 3>;
using Color = std::array<std::uint16_t, 4>;

/// The linear value of an 8-bit one of sRGB (IEC 61966-2-1), of which 65535 is white.
std::uint16_t linear(std::uint8_t srgb) {
  const double value = srgb / 255.0;
  const double result = value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
  return static_cast<std::uint16_t>(std::lround(65535 * result));
}

/// What the file holds beside its description.
struct Buffers {
  std::vector<Place> places;
  std::vector<Color> colors;
  std::vector<std::uint32_t> indices;      // of triangles, surface by surface
  std::vector<std::size_t> first_indices;  // of each surface; one more is the end
  Place low{};
  Place high{};

  [[nodiscard]] std::size_t bytes() const {
    return kPlaceBytes * places.size() + kColorBytes * colors.size() + 4 * indices.size();
  }
};

Buffers make_buffers(const PatchMesh& mesh, const ColoredMesh& colored) {
  Buffers buffers;
  std::array<std::uint16_t, 256> linear_of{};
  for (std::size_t k = 0; k < 256; ++k) linear_of[k] = linear(static_cast<std::uint8_t>(k));
  buffers.low.fill(std::numeric_limits<float>::max());
  buffers.high.fill(std::numeric_limits<float>::lowest());
  for (const ColoredMesh::Vertex& vertex : colored.vertices) {
    Place place{};
    for (int axis = 0; axis < 3; ++axis) {
      place[axis] = static_cast<float>(mesh.vertices[vertex.vertex][axis]);
      buffers.low[axis] = std::min(buffers.low[axis], place[axis]);
      buffers.high[axis] = std::max(buffers.high[axis], place[axis]);
    }
    buffers.places.push_back(place);
    const auto& [red, green, blue] = vertex.color;
    buffers.colors.push_back({linear_of[red], linear_of[green], linear_of[blue], 65535});
  }
  std::vector<std::vector<std::int32_t>> patches(mesh.surface_names.size());
  for (Index i = 0; i < mesh.size(); ++i) {
    patches[mesh.surface[i]].push_back(static_cast<std::int32_t>(i));
  }
  for (const std::vector<std::int32_t>& of_surface : patches) {
    buffers.first_indices.push_back(buffers.indices.size());
    for (const std::int32_t patch : of_surface) {
      const auto& corners = colored.corners[patch];
      for (int k = 2; k < mesh.n_corners(patch); ++k) {
        for (const int corner : {0, k - 1, k}) {
          buffers.indices.push_back(static_cast<std::uint32_t>(corners[corner]));
        }
      }
    }
  }
  buffers.first_indices.push_back(buffers.indices.size());
  return buffers;
}

Json view(std::size_t offset, std::size_t length, int target) {
  return {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", length}, {"target", target}};
}

Json description(const PatchMesh& mesh, const Buffers& buffers, UpAxis up) {
  const std::size_t colors_at = kPlaceBytes * buffers.places.size();
  const std::size_t indices_at = colors_at + kColorBytes * buffers.colors.size();
  Json json = {{"asset", {{"version", "2.0"}, {"generator", "radiosity"}}},
               {"extensionsUsed", {"KHR_materials_unlit"}},
               {"scene", 0},
               {"buffers", {{{"byteLength", buffers.bytes()}}}},
               {"bufferViews",
                {view(0, colors_at, kVertexBuffer),
                 view(colors_at, kColorBytes * buffers.colors.size(), kVertexBuffer),
                 view(indices_at, 4 * buffers.indices.size(), kIndexBuffer)}},
               {"materials",
                {{{"name", "light"},
                  {"pbrMetallicRoughness", {{"metallicFactor", 0}, {"roughnessFactor", 1}}},
                  {"extensions", {{"KHR_materials_unlit", Json::object()}}}}}},
               {"accessors",
                {{{"bufferView", 0},
                  {"componentType", kFloat},
                  {"count", buffers.places.size()},
                  {"type", "VEC3"},
                  {"min", buffers.low},
                  {"max", buffers.high}},
                 {{"bufferView", 1},
                  {"componentType", kUnsignedShort},
                  {"normalized", true},
                  {"count", buffers.colors.size()},
                  {"type", "VEC4"}}}}};
  Json nodes = Json::array();
  Json meshes = Json::array();
  Json children = Json::array();
  for (std::size_t s = 0; s + 1 < buffers.first_indices.size(); ++s) {
    const std::size_t first = buffers.first_indices[s];
    const std::size_t n = buffers.first_indices[s + 1] - first;
    if (n == 0) continue;
    const std::string name = printable(mesh.surface_names[s]);
    children.push_back(nodes.size());
    nodes.push_back({{"name", name}, {"mesh", meshes.size()}});
    meshes.push_back({{"name", name},
                      {"primitives",
                       {{{"attributes", {{"POSITION", 0}, {"COLOR_0", 1}}},
                         {"indices", json["accessors"].size()},
                         {"material", 0}}}}});
    json["accessors"].push_back({{"bufferView", 2},
                                 {"byteOffset", 4 * first},
                                 {"componentType", kUnsignedInt},
                                 {"count", n},
                                 {"type", "SCALAR"}});
  }
  Json root = {{"name", "scene"}, {"children", children}};
  // A quarter turn about x, from z to y.
  if (up == UpAxis::z) root["rotation"] = {-std::sqrt(0.5), 0, 0, std::sqrt(0.5)};
  json["scenes"] = {{{"nodes", {nodes.size()}}}};
  nodes.push_back(root);
  json["nodes"] = nodes;
  json["meshes"] = meshes;
  return json;
}

template <typename T>
void put(std::ostream& stream, const std::vector<T>& values) {
  stream.write(reinterpret_cast<const char*>(values.data()),
               static_cast<std::streamsize>(values.size() * sizeof(T)));
}

}  // namespace

void write_color_glb(const std::filesystem::path& path, const PatchMesh& mesh,
                     const CornerColors& colors, UpAxis up) {
  static_assert(std::endian::native == std::endian::little, "glTF is little endian");
  const Buffers buffers = make_buffers(mesh, color_corners(mesh, colors));
  std::string text = description(mesh, buffers, up).dump();
  text.resize((text.size() + 3) / 4 * 4, ' ');
  constexpr std::size_t kHeads = 12 + 8 + 8;
  const std::size_t size = kHeads + text.size() + buffers.bytes();
  if (size > std::numeric_limits<std::uint32_t>::max()) {
    throw radiosity::OutputError(
        fmt::format("{}: would have {} bytes, more than a .glb can", path.string(), size));
  }
  const auto word = [](std::size_t value) { return static_cast<std::uint32_t>(value); };
  write_stream_atomically(path, [&](std::ofstream& stream) {
    put(stream, std::vector<std::uint32_t>{kMagic, 2, word(size), word(text.size()), kJsonChunk});
    stream << text;
    put(stream, std::vector<std::uint32_t>{word(buffers.bytes()), kBinaryChunk});
    put(stream, buffers.places);
    put(stream, buffers.colors);
    put(stream, buffers.indices);
  });
}

}  // namespace io
