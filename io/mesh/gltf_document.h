#pragma once

#include <cstdint>
#include <deque>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/base/json_item.h"
#include "radiosity/base/progress.h"

namespace io {

/// Values of a glTF accessor.
struct GltfValues {
  std::int64_t count = 0;
  int n_components = 0;
  std::vector<double> values;  ///< count × n_components
  double quantum = 0;          ///< what one step of an integer component is worth; 0 of floats

  [[nodiscard]] double operator()(std::int64_t i, int component) const {
    return values[static_cast<std::size_t>(i * n_components + component)];
  }
};

/// The JSON of a glTF file and its binary data: .gltf with its buffers, or .glb. Everything that it
/// returns is checked against what is there. All functions throw SceneError naming file and item.
class GltfDocument {
 public:
  GltfDocument(const std::filesystem::path& path, const radiosity::Progress& progress);

  [[nodiscard]] JsonItem root() const { return {json_, path_}; }
  /// Element of a list of the document ("meshes") that an item gives the index of.
  [[nodiscard]] JsonItem element(std::string_view list, const JsonItem& index) const;
  /// The same by number, which must be below size().
  [[nodiscard]] JsonItem element(std::string_view list, std::size_t index) const;
  /// Number of elements of a list; 0 if there is none.
  [[nodiscard]] std::size_t size(std::string_view list) const;

  /// Number of values that an accessor says it has, without reading them.
  [[nodiscard]] static std::int64_t count(const JsonItem& accessor);
  /// The values of an accessor of a type ("VEC3"), as floats or integers; sparse ones too.
  [[nodiscard]] GltfValues values(const JsonItem& accessor, std::string_view type);

  /// The bytes of an image: in a buffer view, in its URI or in the file that this names.
  [[nodiscard]] std::string_view image(const JsonItem& image);

  /// Bytes of the file and of the files that its buffers name, each once.
  [[nodiscard]] std::uint64_t n_bytes() const { return n_bytes_; }
  [[nodiscard]] std::vector<std::string> take_repairs() { return std::move(repairs_); }

 private:
  struct View {
    std::string_view bytes;
    std::int64_t stride = 0;  ///< bytes from one value to the next; 0 = they follow each other
  };

  void check_version() const;
  void split_binary(std::string_view file);
  std::string_view buffer(const JsonItem& index);
  std::string_view load_buffer(const JsonItem& buffer, std::size_t index);
  std::string_view load_data(const JsonItem& uri);
  std::string_view load_file(const JsonItem& uri);
  [[nodiscard]] std::filesystem::path file_of(const std::string& uri) const;
  void count_bytes();
  View view(const JsonItem& index);

  std::filesystem::path path_;
  const radiosity::Progress& progress_;
  Json json_;
  std::optional<std::string> binary_chunk_;
  std::vector<std::optional<std::string_view>> buffers_;  // of binary_chunk_, data_ and files_
  std::deque<std::string> data_;
  std::map<std::filesystem::path, std::string> files_;  // read once, whatever refers to them
  std::uint64_t n_bytes_ = 0;
  std::vector<std::string> repairs_;
};

/// The name of an item; empty if it has none.
std::string gltf_name(const JsonItem& item);

/// A whole number that is not negative and at most `largest`.
std::int64_t gltf_integer(const JsonItem& item, std::int64_t largest);

}  // namespace io
