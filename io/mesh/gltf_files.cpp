#include "io/mesh/gltf_files.h"

#include <array>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "io/base/byte_reader.h"
#include "io/base/extension.h"
#include "io/mesh/uri_text.h"

namespace io {
namespace {

/// The text of the file, or of a .glb's first chunk: a header of 12 bytes, then length and type of
/// the chunk, then its content.
std::string json_text(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  if (lower_case_extension(path) != ".glb") return {std::istreambuf_iterator<char>(stream), {}};
  std::array<char, 20> header{};
  stream.read(header.data(), header.size());
  std::error_code error;
  const auto size = load<std::uint32_t>(header.data() + 12, std::endian::little);
  if (!stream || size > std::filesystem::file_size(path, error) || error) return {};
  std::string text(size, '\0');
  stream.read(text.data(), size);
  return text;
}

}  // namespace

std::vector<std::filesystem::path> gltf_files(const std::filesystem::path& path) {
  const nlohmann::json json = nlohmann::json::parse(json_text(path), nullptr, false);
  std::vector<std::filesystem::path> files;
  if (!json.is_object()) return files;
  for (const char* list : {"buffers", "images"}) {
    if (!json.contains(list) || !json[list].is_array()) continue;
    for (const nlohmann::json& item : json[list]) {
      if (!item.is_object() || !item.contains("uri") || !item["uri"].is_string()) continue;
      const auto uri = item["uri"].get<std::string>();
      if (!uri.starts_with("data:")) files.push_back(path.parent_path() / decode_percent(uri));
    }
  }
  return files;
}

}  // namespace io
