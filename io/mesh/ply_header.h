#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/base/line_reader.h"

namespace io {

enum class PlyFormat { ascii, little_endian, big_endian };
enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

/// Bytes that a value takes in a binary file.
std::uint64_t ply_size(PlyType type);

struct PlyProperty {
  enum class Role { skipped, x, y, z, indices };
  PlyType type = PlyType::float32;
  std::optional<PlyType> count_type;  ///< of a list: the type of its length
  Role role = Role::skipped;
};

struct PlyElement {
  enum class Kind { vertex, face, other };
  Kind kind = Kind::other;
  std::string name;
  std::int64_t count = 0;  ///< >= 0
  std::vector<PlyProperty> properties;
};

struct PlyHeader {
  PlyFormat format = PlyFormat::ascii;
  std::vector<PlyElement> elements;  ///< file order
  std::int64_t n_vertices = 0;
  std::vector<std::string> repairs;  ///< see FileScene
};

/// Reads the header up to `end_header` and checks that it has vertices with x, y, z and faces with
/// indices. Lines that begin with no word of the format are left out. Throws SceneError with file
/// and line.
PlyHeader read_ply_header(const std::filesystem::path& path, LineReader& lines);

}  // namespace io
