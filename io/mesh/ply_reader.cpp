#include "io/mesh/ply_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/base/byte_reader.h"
#include "io/base/input_checks.h"
#include "io/base/line_reader.h"
#include "io/mesh/ply_header.h"

namespace io {
namespace {

using radiosity::Progress;
using radiosity::Scene;
using radiosity::Vec3;
using Role = PlyProperty::Role;
using Kind = PlyElement::Kind;

/// The values of an ascii file: one element per line.
class AsciiSource {
 public:
  explicit AsciiSource(LineReader& lines) : lines_(lines) {}

  void next_row(const PlyElement& element, std::int64_t row) {
    do {
      if (!lines_.next_line()) {
        lines_.fail(fmt::format("file ends after {} of {} elements \"{}\"", row, element.count,
                                element.name));
      }
    } while (trimmed(lines_.line()).empty());
    words_ = Words(lines_.line());
  }
  double real(PlyType /*type*/) { return lines_.number(words_, "a coordinate"); }
  std::int64_t integer(PlyType /*type*/) { return lines_.integer(words_, "an index or length"); }
  void skip(PlyType /*type*/, std::int64_t n) {
    for (std::int64_t k = 0; k < n; ++k) {
      if (words_.next().empty()) lines_.fail("line ends where a value is expected");
    }
  }
  [[noreturn]] void fail(const std::string& message) const { lines_.fail(message); }
  /// Bytes that the smallest possible element takes: numbers and blanks or line ends.
  static std::uint64_t smallest_row(const PlyElement& element) {
    return 2 * element.properties.size();
  }

 private:
  LineReader& lines_;
  Words words_{""};
};

/// The values of a binary file.
class BinarySource {
 public:
  BinarySource(const std::filesystem::path& path, std::uint64_t offset, std::endian order,
               const Progress& progress)
      : path_(path), bytes_(path, offset, progress), order_(order) {}

  void next_row(const PlyElement& element, std::int64_t row) {
    name_ = element.name;
    row_ = row;
  }
  double real(PlyType type) {
    if (type == PlyType::float64) return load<double>(bytes_.take(8), order_);
    if (type == PlyType::float32) return load<float>(bytes_.take(4), order_);
    return static_cast<double>(integer(type));
  }
  std::int64_t integer(PlyType type) {
    const char* bytes = bytes_.take(ply_size(type));
    switch (type) {
      case PlyType::int8:
        return load<std::int8_t>(bytes, order_);
      case PlyType::uint8:
        return load<std::uint8_t>(bytes, order_);
      case PlyType::int16:
        return load<std::int16_t>(bytes, order_);
      case PlyType::uint16:
        return load<std::uint16_t>(bytes, order_);
      case PlyType::int32:
        return load<std::int32_t>(bytes, order_);
      case PlyType::uint32:
        return load<std::uint32_t>(bytes, order_);
      default:
        break;
    }
    fail("expected an integer type");
  }
  void skip(PlyType type, std::int64_t n) { bytes_.take(ply_size(type) * n); }
  /// Bytes of the file that were not read yet.
  [[nodiscard]] std::uint64_t n_left() const { return bytes_.size() - bytes_.offset(); }
  [[noreturn]] void fail(const std::string& message) const {
    io::fail(path_, fmt::format("{} {}: {}", name_, row_, message));
  }
  static std::uint64_t smallest_row(const PlyElement& element) {
    std::uint64_t size = 0;
    for (const PlyProperty& property : element.properties) {
      size += ply_size(property.count_type.value_or(property.type));
    }
    return size;
  }

 private:
  std::filesystem::path path_;
  ByteReader bytes_;
  std::endian order_;
  std::string name_;
  std::int64_t row_ = 0;
};

/// Refuses counts that the file is too small for, before memory is taken for them.
template <typename Source>
void check_size(const std::filesystem::path& path, const LineReader& lines,
                const PlyHeader& header) {
  double expected = static_cast<double>(lines.offset());
  for (const PlyElement& element : header.elements) {
    expected +=
        static_cast<double>(Source::smallest_row(element)) * static_cast<double>(element.count);
  }
  if (header.format == PlyFormat::ascii) expected -= 1;  // the last line may lack its end
  if (expected > static_cast<double>(lines.size())) {
    fail(path, fmt::format("is truncated: found {} bytes, expected at least {:.0f}", lines.size(),
                           expected));
  }
}

template <typename Source>
std::int64_t read_length(Source& source, PlyType type) {
  const std::int64_t length = source.integer(type);
  if (length < 0) source.fail(fmt::format("a list has the length {}", length));
  return length;
}

template <typename Source>
void skip_property(Source& source, const PlyProperty& property) {
  source.skip(property.type, property.count_type ? read_length(source, *property.count_type) : 1);
}

template <typename Source>
void read_vertices(Source& source, const PlyElement& element, Scene& scene) {
  scene.vertices.reserve(element.count);
  for (std::int64_t row = 0; row < element.count; ++row) {
    source.next_row(element, row);
    Vec3 point;
    for (const PlyProperty& property : element.properties) {
      if (property.role == Role::skipped) {
        skip_property(source, property);
      } else {
        point[static_cast<int>(property.role) - static_cast<int>(Role::x)] =
            source.real(property.type);
      }
    }
    if (!point.allFinite()) source.fail("coordinate is not finite");
    scene.vertices.push_back(point);
  }
}

template <typename Source>
void read_faces(Source& source, const PlyElement& element, std::int64_t n_vertices, Scene& scene) {
  scene.polygon_surface.reserve(element.count);
  scene.first_corner.reserve(element.count + 1);
  std::vector<std::int64_t> face;
  std::vector<std::int32_t> corners;
  for (std::int64_t row = 0; row < element.count; ++row) {
    source.next_row(element, row);
    for (const PlyProperty& property : element.properties) {
      if (property.role == Role::skipped) {
        skip_property(source, property);
        continue;
      }
      face.clear();
      const std::int64_t length = read_length(source, *property.count_type);
      for (std::int64_t k = 0; k < length; ++k) face.push_back(source.integer(property.type));
    }
    if (const auto problem = index_problem(face, n_vertices)) source.fail(*problem);
    corners.assign(face.begin(), face.end());
    scene.add_polygon(corners, 0);
  }
}

template <typename Source>
Scene read_elements(Source& source, const PlyHeader& header) {
  Scene scene;
  for (const PlyElement& element : header.elements) {
    if (element.kind == Kind::vertex) {
      read_vertices(source, element, scene);
    } else if (element.kind == Kind::face) {
      read_faces(source, element, header.n_vertices, scene);
    } else {
      for (std::int64_t row = 0; row < element.count; ++row) {
        source.next_row(element, row);
        for (const PlyProperty& property : element.properties) skip_property(source, property);
      }
    }
  }
  return scene;
}

}  // namespace

FileScene read_ply(const std::filesystem::path& path, const Progress& progress) {
  LineReader lines(path, progress);
  const PlyHeader header = read_ply_header(path, lines);
  Scene scene;
  std::vector<std::string> repairs = header.repairs;
  if (header.format == PlyFormat::ascii) {
    check_size<AsciiSource>(path, lines, header);
    AsciiSource source(lines);
    scene = read_elements(source, header);
    long n_lines = 0;
    while (lines.next_line()) n_lines += trimmed(lines.line()).empty() ? 0 : 1;
    if (n_lines > 0) {
      repairs.push_back(fmt::format("{}: {} more lines after the last element are ignored",
                                    path.string(), n_lines));
    }
  } else {
    check_size<BinarySource>(path, lines, header);
    const bool is_little = header.format == PlyFormat::little_endian;
    BinarySource source(path, lines.offset(), is_little ? std::endian::little : std::endian::big,
                        progress);
    scene = read_elements(source, header);
    if (source.n_left() > 0) {
      repairs.push_back(fmt::format("{}: {} bytes after the last element are ignored",
                                    path.string(), source.n_left()));
    }
  }
  scene.surfaces.push_back({.name = path.stem().string(), .material = -1, .two_sided = false});
  return {std::move(scene), std::move(repairs)};
}

}  // namespace io
