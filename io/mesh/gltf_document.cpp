#include "io/mesh/gltf_document.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

#include "io/base/byte_reader.h"
#include "io/base/extension.h"
#include "io/base/line_reader.h"
#include "io/base/printable.h"
#include "io/mesh/uri_text.h"
#include "radiosity/base/error.h"

namespace io {
namespace {

using radiosity::Progress;

constexpr std::int64_t kMostValues = std::numeric_limits<std::int32_t>::max();
/// Values that only a sparse accessor gives are zeros that no byte of the file stands for.
constexpr std::int64_t kMostZeros = 1'000'000;

std::string read_bytes(const std::filesystem::path& path, std::uint64_t n,
                       const Progress& progress) {
  std::string text;
  ByteReader bytes(path, 0, progress);
  constexpr std::uint64_t kPart = 1 << 16;
  n = std::min(n, bytes.size());
  text.reserve(n);
  while (text.size() < n) {
    const std::uint64_t part = std::min(kPart, n - text.size());
    text.append(bytes.take(part), part);
  }
  return text;
}

struct ComponentType {
  int code;
  int size;        // bytes
  double largest;  // of an integer, which means 1 where it is normalised; 0 of floats
};

constexpr std::array<ComponentType, 6> kComponentTypes = {{{5120, 1, 127},
                                                           {5121, 1, 255},
                                                           {5122, 2, 32767},
                                                           {5123, 2, 65535},
                                                           {5125, 4, 4294967295.0},
                                                           {5126, 4, 0}}};

ComponentType component_type(const JsonItem& item) {
  const std::int64_t code = gltf_integer(item, kMostValues);
  for (const ComponentType& type : kComponentTypes) {
    if (type.code == code) return type;
  }
  item.fail(fmt::format("is {}, expected one of 5120 to 5123, 5125 or 5126", code));
}

double component(const char* bytes, const ComponentType& type) {
  constexpr auto kOrder = std::endian::little;
  switch (type.code) {
    case 5120:
      return load<std::int8_t>(bytes, kOrder);
    case 5121:
      return load<std::uint8_t>(bytes, kOrder);
    case 5122:
      return load<std::int16_t>(bytes, kOrder);
    case 5123:
      return load<std::uint16_t>(bytes, kOrder);
    case 5125:
      return load<std::uint32_t>(bytes, kOrder);
    default:
      return load<float>(bytes, kOrder);
  }
}

int component_count(std::string_view type) {
  if (type == "SCALAR") return 1;
  if (type == "VEC2") return 2;
  return type == "VEC3" ? 3 : 4;
}

std::int64_t offset_of(const JsonItem& item) {
  const auto offset = item.find("byteOffset");
  return offset ? gltf_integer(*offset, std::numeric_limits<std::int64_t>::max()) : 0;
}

/// Where n values of `size` bytes each stand in `bytes`; refuses those that do not fit.
const char* checked_start(const JsonItem& item, std::string_view bytes, std::int64_t offset,
                          std::int64_t stride, std::int64_t n, std::int64_t size) {
  const double end = static_cast<double>(offset) +
                     static_cast<double>(stride) * static_cast<double>(n - 1) +
                     static_cast<double>(size);
  if (n > 0 && end > static_cast<double>(bytes.size())) {
    item.fail(fmt::format("its {} values end at byte {:.0f}, but its buffer view has {}", n, end,
                          bytes.size()));
  }
  return bytes.data() + (n > 0 ? offset : 0);
}

}  // namespace

std::int64_t gltf_integer(const JsonItem& item, std::int64_t largest) {
  const double value = item.number();
  if (!(value >= 0 && value <= static_cast<double>(largest) && value < 0x1p53) ||
      value != std::floor(value)) {
    item.fail(fmt::format("is {}, expected a whole number from 0 to {}", value, largest));
  }
  return static_cast<std::int64_t>(value);
}

GltfDocument::GltfDocument(const std::filesystem::path& path, const Progress& progress)
    : path_(path), progress_(progress) {
  const std::string file = read_bytes(path, input_size(path), progress);
  n_bytes_ = file.size();
  if (lower_case_extension(path) == ".glb" || file.starts_with("glTF")) {
    split_binary(file);
  } else {
    json_ = parse_json_text(path, file);
  }
  if (!json_.is_object()) fail(path_, "is no glTF: expected an object");
  check_version();
  buffers_.resize(size("buffers"));
  count_bytes();
}

/// What is there, not what the document says to be there.
void GltfDocument::count_bytes() {
  std::set<std::filesystem::path> counted;
  for (std::size_t i = 0; i < size("buffers"); ++i) {
    const auto uri = element("buffers", i).find("uri");
    if (!uri || !uri->value().is_string()) continue;
    const auto name = uri->value().get<std::string>();
    if (name.starts_with("data:")) continue;
    std::error_code error;
    const std::filesystem::path path = file_of(name);
    if (!counted.insert(path).second || !std::filesystem::is_regular_file(path, error)) continue;
    const auto n = std::filesystem::file_size(path, error);
    if (!error) n_bytes_ += n;
  }
}

/// Before anything else: glTF 1.0 has objects where 2.0 has lists.
void GltfDocument::check_version() const {
  if (root().has("buffers") && root().at("buffers").value().is_object()) {
    fail(path_, "is glTF 1.0, expected 2.0");
  }
  const std::string name = root().at("asset").at("version").text();
  if (!name.starts_with("2")) fail(path_, fmt::format("is glTF {}, expected 2.0", in_quotes(name)));
}

/// A header of 12 bytes; then chunks, each with its length and type: JSON, then perhaps BIN.
void GltfDocument::split_binary(std::string_view file) {
  constexpr std::size_t kHeader = 12;
  constexpr std::size_t kChunkHeader = 8;
  const auto number = [&](std::size_t at) {
    return load<std::uint32_t>(file.data() + at, std::endian::little);
  };
  if (!file.starts_with("glTF")) fail(path_, "is no binary glTF: it does not start with \"glTF\"");
  if (file.size() < kHeader + kChunkHeader) {
    fail(path_, fmt::format("is truncated: found {} bytes, expected at least {}", file.size(),
                            kHeader + kChunkHeader));
  }
  if (number(4) != 2) fail(path_, fmt::format("is binary glTF {}, expected 2", number(4)));
  const std::uint32_t length = number(8);
  if (length > file.size()) {
    fail(path_, fmt::format("is truncated: found {} bytes, expected {}", file.size(), length));
  }
  if (length < file.size()) {
    repairs_.push_back(fmt::format("{}: {} bytes after the end that it states are ignored",
                                   path_.string(), file.size() - length));
    file = file.substr(0, length);
  }
  std::size_t at = kHeader;
  for (int k = 0; k < 2 && at + kChunkHeader <= file.size(); ++k) {
    const std::uint32_t n = number(at);
    const std::string_view type = file.substr(at + 4, 4);
    at += kChunkHeader;
    if (n > file.size() - at) {
      fail(path_, fmt::format("chunk {} is truncated: found {} bytes, expected {}", k,
                              file.size() - at, n));
    }
    const std::string_view chunk = file.substr(at, n);
    if (k == 0) {
      if (type != "JSON") fail(path_, "the first chunk is not JSON");
      json_ = parse_json_text(path_, chunk);
    } else if (type == std::string_view("BIN\0", 4)) {
      binary_chunk_ = chunk;
    }
    at += n;
  }
  if (json_.is_null()) fail(path_, "has no JSON chunk");
}

JsonItem GltfDocument::element(std::string_view list, const JsonItem& index) const {
  const std::size_t n = size(list);
  const std::int64_t i = gltf_integer(index, kMostValues);
  if (static_cast<std::size_t>(i) >= n) {
    index.fail(fmt::format("is {}, but there are {} {}, counted from 0", i, n, list));
  }
  return element(list, static_cast<std::size_t>(i));
}

JsonItem GltfDocument::element(std::string_view list, std::size_t index) const {
  return root().at(list)[index];
}

std::size_t GltfDocument::size(std::string_view list) const {
  const auto item = root().find(list);
  return item ? item->size() : 0;
}

std::string_view GltfDocument::buffer(const JsonItem& index) {
  const JsonItem item = element("buffers", index);
  const auto i = static_cast<std::size_t>(index.number());
  if (!buffers_[i]) buffers_[i] = load_buffer(item, i);
  return *buffers_[i];
}

std::string_view GltfDocument::load_buffer(const JsonItem& buffer, std::size_t index) {
  const auto length = static_cast<std::uint64_t>(gltf_integer(buffer.at("byteLength"), 1LL << 40));
  std::string_view bytes;
  if (const auto uri = buffer.find("uri")) {
    bytes = uri->text().starts_with("data:") ? load_data(*uri) : load_file(*uri);
  } else {
    if (index > 0 || !binary_chunk_)
      buffer.fail("has no \"uri\", and the file has no binary chunk");
    bytes = *binary_chunk_;
  }
  if (bytes.size() < length) {
    buffer.fail(fmt::format("is truncated: found {} bytes, expected {}", bytes.size(), length));
  }
  return bytes.substr(0, length);
}

std::string_view GltfDocument::load_data(const JsonItem& uri) {
  const std::string text = uri.text();
  const auto comma = text.find(',');
  if (comma == std::string::npos || !text.substr(0, comma).ends_with(";base64")) {
    uri.fail("is a data URI without base64");
  }
  auto decoded = decode_base64(std::string_view(text).substr(comma + 1));
  if (!decoded) uri.fail("is no base64");
  return data_.emplace_back(*std::move(decoded));
}

std::string_view GltfDocument::image(const JsonItem& image) {
  if (const auto uri = image.find("uri")) {
    return uri->text().starts_with("data:") ? load_data(*uri) : load_file(*uri);
  }
  return view(image.at("bufferView")).bytes;
}

std::string_view GltfDocument::load_file(const JsonItem& uri) {
  const std::string text = uri.text();
  if (text.find("://") != std::string::npos) {
    uri.fail(in_quotes(text) + " is not a file; only files beside it are read");
  }
  const std::filesystem::path path = file_of(text);
  const auto known = files_.find(path);
  if (known != files_.end()) return known->second;
  try {
    return files_.emplace(path, read_bytes(path, input_size(path), progress_)).first->second;
  } catch (const radiosity::SceneError& error) {
    uri.fail(error.what());
  }
}

std::filesystem::path GltfDocument::file_of(const std::string& uri) const {
  const std::filesystem::path path = path_.parent_path() / decode_percent(uri);
  std::error_code error;
  std::filesystem::path same = std::filesystem::weakly_canonical(path, error);
  return error ? path : same;
}

GltfDocument::View GltfDocument::view(const JsonItem& index) {
  const JsonItem item = element("bufferViews", index);
  const std::string_view bytes = buffer(item.at("buffer"));
  const std::int64_t offset = offset_of(item);
  const std::int64_t length = gltf_integer(item.at("byteLength"), 1LL << 40);
  const auto size = static_cast<std::int64_t>(bytes.size());
  if (offset > size || length > size - offset) {
    item.fail(fmt::format("its {} bytes from byte {} on are more than its buffer has, {}", length,
                          offset, size));
  }
  const auto stride = item.find("byteStride");
  return {bytes.substr(static_cast<std::size_t>(offset), static_cast<std::size_t>(length)),
          stride ? gltf_integer(*stride, 1 << 20) : 0};
}

std::int64_t GltfDocument::count(const JsonItem& accessor) {
  return gltf_integer(accessor.at("count"), kMostValues);
}

GltfValues GltfDocument::values(const JsonItem& accessor, std::string_view type) {
  if (const std::string found = accessor.at("type").text(); found != type) {
    accessor.fail(fmt::format("has the type {}, expected {}", in_quotes(found), type));
  }
  const ComponentType stored = component_type(accessor.at("componentType"));
  const auto normalized = accessor.find("normalized");
  const bool is_normalized = stored.largest > 0 && normalized && normalized->boolean();
  GltfValues result{.count = count(accessor), .n_components = component_count(type), .values = {}};
  if (stored.largest > 0) result.quantum = is_normalized ? 1 / stored.largest : 1;
  const std::int64_t size = static_cast<std::int64_t>(stored.size) * result.n_components;
  const auto read_value = [&](const char* bytes, double* value) {
    for (int k = 0; k < result.n_components; ++k) {
      const double raw = component(bytes + static_cast<std::ptrdiff_t>(k) * stored.size, stored);
      // glTF 2.0, 3.11: signed integers have one value too many below -1.
      value[k] = is_normalized ? std::max(raw / stored.largest, -1.0) : raw;
    }
  };
  const auto view_index = accessor.find("bufferView");
  const auto sparse = accessor.find("sparse");
  if (!view_index && !sparse) accessor.fail("has no \"bufferView\": compressed or missing data");
  if (!view_index && result.count > kMostZeros) {
    accessor.fail(fmt::format("has {} values and no buffer view, expected at most {}", result.count,
                              kMostZeros));
  }
  const auto allocate = [&] {
    result.values.resize(static_cast<std::size_t>(result.count * result.n_components));
  };
  if (view_index) {
    const View found = view(*view_index);
    const std::int64_t stride = found.stride > 0 ? found.stride : size;
    const char* bytes =
        checked_start(accessor, found.bytes, offset_of(accessor), stride, result.count, size);
    allocate();
    for (std::int64_t i = 0; i < result.count; ++i) {
      read_value(bytes + i * stride, result.values.data() + i * result.n_components);
    }
  } else {
    allocate();
  }
  if (!sparse) return result;

  const std::int64_t n = gltf_integer(sparse->at("count"), result.count);
  const JsonItem indices = sparse->at("indices");
  const JsonItem given = sparse->at("values");
  const ComponentType index_type = component_type(indices.at("componentType"));
  const View index_view = view(indices.at("bufferView"));
  const View value_view = view(given.at("bufferView"));
  const char* index_bytes = checked_start(indices, index_view.bytes, offset_of(indices),
                                          index_type.size, n, index_type.size);
  const char* value_bytes = checked_start(given, value_view.bytes, offset_of(given), size, n, size);
  for (std::int64_t i = 0; i < n; ++i) {
    const double at = component(index_bytes + i * index_type.size, index_type);
    if (!(at >= 0 && at < static_cast<double>(result.count))) {
      indices.fail(fmt::format("gives value {}, but there are {}", at, result.count));
    }
    read_value(value_bytes + i * size,
               result.values.data() + static_cast<std::int64_t>(at) * result.n_components);
  }
  return result;
}

std::string gltf_name(const JsonItem& item) {
  const auto name = item.find("name");
  return name && name->value().is_string() ? name->value().get<std::string>() : std::string();
}

}  // namespace io
