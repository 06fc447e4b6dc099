#include "io/result/glb_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "io/base/atomic_file.h"
#include "io/base/printable.h"
#include "radiosity/base/error.h"

namespace io {
namespace {

using Json = nlohmann::ordered_json;

// Names that glTF gives to numbers.
constexpr int kUnsignedShort = 5123;
constexpr int kUnsignedInt = 5125;
constexpr int kFloat = 5126;
constexpr int kVertexBuffer = 34962;
constexpr int kIndexBuffer = 34963;
constexpr int kLinear = 9729;
constexpr int kClampToEdge = 33071;
constexpr std::uint32_t kMagic = 0x46546C67;  // "glTF"
constexpr std::uint32_t kJsonChunk = 0x4E4F534A;
constexpr std::uint32_t kBinaryChunk = 0x004E4942;

/// Bytes of a vertex: three floats, and three shorts that a fourth fills up to a multiple of 4, or
/// two floats.
constexpr std::size_t kPlaceBytes = 12;
constexpr std::size_t kAttributeBytes = 8;

std::size_t bytes_of(const GlbMesh& mesh) {
  return (kPlaceBytes + kAttributeBytes) * mesh.places.size() + 4 * mesh.indices.size() +
         (mesh.picture.size() + 3) / 4 * 4;
}

Json view(std::size_t offset, std::size_t length, int target) {
  return {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", length}, {"target", target}};
}

Json views(const GlbMesh& mesh) {
  const std::size_t attribute_at = kPlaceBytes * mesh.places.size();
  const std::size_t indices_at = attribute_at + kAttributeBytes * mesh.places.size();
  const std::size_t picture_at = indices_at + 4 * mesh.indices.size();
  Json result = {view(0, attribute_at, kVertexBuffer),
                 view(attribute_at, kAttributeBytes * mesh.places.size(), kVertexBuffer),
                 view(indices_at, 4 * mesh.indices.size(), kIndexBuffer)};
  if (!mesh.picture.empty()) {
    result.push_back(
        {{"buffer", 0}, {"byteOffset", picture_at}, {"byteLength", mesh.picture.size()}});
  }
  return result;
}

Json vertex_accessors(const GlbMesh& mesh) {
  constexpr float kMost = std::numeric_limits<float>::max();
  std::array<float, 3> low = {kMost, kMost, kMost};
  std::array<float, 3> high = {-kMost, -kMost, -kMost};
  for (const auto& place : mesh.places) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], place[axis]);
      high[axis] = std::max(high[axis], place[axis]);
    }
  }
  Json places = {{"bufferView", 0},
                 {"componentType", kFloat},
                 {"count", mesh.places.size()},
                 {"type", "VEC3"},
                 {"min", low},
                 {"max", high}};
  Json attribute = {{"bufferView", 1},
                    {"componentType", kUnsignedShort},
                    {"normalized", true},
                    {"count", mesh.places.size()},
                    {"type", "VEC4"}};
  if (!mesh.picture.empty()) {
    attribute = {{"bufferView", 1},
                 {"componentType", kFloat},
                 {"count", mesh.places.size()},
                 {"type", "VEC2"}};
  }
  return {places, attribute};
}

Json material(const GlbMesh& mesh) {
  Json shown = {{"metallicFactor", 0}, {"roughnessFactor", 1}};
  if (!mesh.picture.empty()) shown["baseColorTexture"] = {{"index", 0}, {"texCoord", 0}};
  return {{"name", "light"},
          {"pbrMetallicRoughness", shown},
          {"extensions", {{"KHR_materials_unlit", Json::object()}}}};
}

Json description(const std::vector<std::string>& surface_names, const GlbMesh& mesh, UpAxis up) {
  Json json = {{"asset", {{"version", "2.0"}, {"generator", "radiosity"}}},
               {"extensionsUsed", {"KHR_materials_unlit"}},
               {"scene", 0},
               {"buffers", {{{"byteLength", bytes_of(mesh)}}}},
               {"bufferViews", views(mesh)},
               {"materials", Json::array({material(mesh)})},
               {"accessors", vertex_accessors(mesh)}};
  Json attributes = {{"POSITION", 0}, {"COLOR_0", 1}};
  if (!mesh.picture.empty()) {
    attributes = {{"POSITION", 0}, {"TEXCOORD_0", 1}, {"TEXCOORD_1", 1}};
    json["images"] = Json::array({{{"bufferView", 3}, {"mimeType", "image/png"}}});
    json["samplers"] = Json::array({{{"magFilter", kLinear},
                                     {"minFilter", kLinear},
                                     {"wrapS", kClampToEdge},
                                     {"wrapT", kClampToEdge}}});
    json["textures"] = Json::array({{{"sampler", 0}, {"source", 0}}});
  }
  Json nodes = Json::array();
  Json meshes = Json::array();
  Json children = Json::array();
  for (std::size_t s = 0; s + 1 < mesh.first_indices.size(); ++s) {
    const std::size_t first = mesh.first_indices[s];
    const std::size_t n = mesh.first_indices[s + 1] - first;
    if (n == 0) continue;
    const std::string name = printable(surface_names[s]);
    children.push_back(nodes.size());
    nodes.push_back({{"name", name}, {"mesh", meshes.size()}});
    meshes.push_back(
        {{"name", name},
         {"primitives",
          {{{"attributes", attributes}, {"indices", json["accessors"].size()}, {"material", 0}}}}});
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

template <typename Values>
void put_all(std::ostream& stream, const Values& values) {
  stream.write(reinterpret_cast<const char*>(values.data()),
               static_cast<std::streamsize>(values.size() * sizeof(values[0])));
}

}  // namespace

UpAxis up_axis(const std::optional<radiosity::Camera>& camera) {
  constexpr double kSteep = 0.9;
  return camera && std::abs(camera->up.z()) > kSteep ? UpAxis::z : UpAxis::y;
}

void write_glb(const std::filesystem::path& path, const std::vector<std::string>& surface_names,
               const GlbMesh& mesh, UpAxis up) {
  static_assert(std::endian::native == std::endian::little, "glTF is little endian");
  std::string text = description(surface_names, mesh, up).dump();
  text.resize((text.size() + 3) / 4 * 4, ' ');
  constexpr std::size_t kHeads = 12 + 8 + 8;
  const std::size_t size = kHeads + text.size() + bytes_of(mesh);
  if (size > std::numeric_limits<std::uint32_t>::max()) {
    throw radiosity::OutputError(
        fmt::format("{}: would have {} bytes, more than a .glb can", path.string(), size));
  }
  const auto word = [](std::size_t value) { return static_cast<std::uint32_t>(value); };
  write_stream_atomically(path, [&](std::ofstream& stream) {
    put_all(stream,
            std::vector<std::uint32_t>{kMagic, 2, word(size), word(text.size()), kJsonChunk});
    stream << text;
    put_all(stream, std::vector<std::uint32_t>{word(bytes_of(mesh)), kBinaryChunk});
    put_all(stream, mesh.places);
    put_all(stream, mesh.colors);
    put_all(stream, mesh.coordinates);
    put_all(stream, mesh.indices);
    put_all(stream, mesh.picture);
    put_all(stream, std::string((4 - mesh.picture.size() % 4) % 4, '\0'));
  });
}

}  // namespace io
