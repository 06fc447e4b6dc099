#include "io/result/vtk_legacy_file.h"

#include <fmt/format.h>

#include <cstring>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "io/base/printable.h"
#include "io/result/vtk_legacy_source.h"
#include "io/result/vtp_values.h"

namespace io {
namespace {

/// Whole numbers as an array of cells.
VtpArray whole_array(std::span<const std::int64_t> values) {
  VtpArray array{.type = "Int64", .n_components = 1, .bytes = {}};
  array.bytes.resize(values.size_bytes());
  if (!values.empty()) std::memcpy(array.bytes.data(), values.data(), values.size_bytes());
  return array;
}

class LegacyReader {
 public:
  explicit LegacyReader(const std::filesystem::path& path) : source_(path) {}

  VtpFile read() {
    std::string key = source_.keyword("DATASET");
    for (; key == "field"; key = source_.keyword("DATASET")) read_field(file_.fields, {});
    if (key != "dataset") unexpected("DATASET", key);
    const std::string kind = source_.keyword("the kind of data");
    if (kind == "unstructured_grid") {
      file_.kind = VtkKind::unstructured;
    } else if (kind != "polydata") {
      source_.fail(
          fmt::format("holds {}, expected POLYDATA or UNSTRUCTURED_GRID", in_quotes(kind)));
    }
    while (!source_.is_at_end()) read_part(source_.keyword("a keyword"));
    check();
    return std::move(file_);
  }

 private:
  [[noreturn]] void unexpected(std::string_view wanted, std::string_view found) const {
    source_.fail(fmt::format("expected {}, found {}", wanted, in_quotes(found)));
  }

  /// What stands behind a keyword between the parts of a file.
  void read_part(const std::string& key) {
    const bool is_grid = file_.kind == VtkKind::unstructured;
    if (key == "points") {
      file_.n_points = source_.count("the number of points");
      file_.points = read_array(number_type(), 3, file_.n_points, "the points");
    } else if (!is_grid && (key == "vertices" || key == "lines" || key == "triangle_strips")) {
      const std::uint64_t n = read_cells(key).size() - 1;
      file_.n_other_cells += n;
      if (key != "triangle_strips") file_.n_verts_and_lines += n;
    } else if (key == (is_grid ? "cells" : "polygons")) {
      const std::vector<std::int64_t> ends = read_cells(key);
      file_.n_polygons = ends.size() - 1;
      file_.polygons["offsets"] = whole_array(std::span(ends).subspan(1));
      file_.polygons["connectivity"] = whole_array(corners_);
    } else if (is_grid && key == "cell_types") {
      const std::uint64_t n = source_.count("the number of types");
      file_.polygons["types"] = read_array("int", 1, n, "the types of the cells");
      n_types_ = n;
    } else if (key == "field" && n_rows_ == 0 && !is_of_points_) {
      read_field(file_.fields, {});
    } else {
      read_attribute(key);
    }
  }

  /// Where each of the cells ends in `corners_`, behind a 0.
  std::vector<std::int64_t> read_cells(const std::string& key) {
    const std::uint64_t n = source_.count("a number of cells");
    const std::uint64_t size = source_.count("their size");
    const std::string label = "the cells of " + key;
    return source_.version() >= 5 ? read_ends_and_corners(n, size, label)
                                  : read_numbers_and_corners(n, size, label);
  }

  std::vector<std::int64_t> read_ends_and_corners(std::uint64_t n_ends, std::uint64_t n_corners,
                                                  const std::string& label) {
    if (n_ends == 0) return {0};
    std::vector<std::int64_t> ends = read_list("offsets", n_ends, label);
    corners_ = read_list("connectivity", n_corners, label);
    if (ends.front() != 0) source_.fail(label + " do not begin with the first corner");
    return ends;
  }

  std::vector<std::int64_t> read_list(const std::string& name, std::uint64_t n,
                                      const std::string& label) {
    const std::string key = source_.keyword(name);
    if (key != name) unexpected(name, key);
    const VtpArray array = read_array(number_type(), 1, n, label);
    if (!is_whole(array)) source_.fail(label + " are no whole numbers");
    return whole_values(array);
  }

  /// Of versions before 5: the number of corners of each cell, then these.
  std::vector<std::int64_t> read_numbers_and_corners(std::uint64_t n, std::uint64_t size,
                                                     const std::string& label) {
    const std::vector<std::int64_t> values = whole_values(read_array("int", 1, size, label));
    std::vector<std::int64_t> ends = {0};
    corners_.clear();
    std::uint64_t place = 0;
    for (std::uint64_t cell = 0; cell < n; ++cell) {
      const std::int64_t n_corners = place < size ? values[place] : -1;
      if (n_corners < 0 || static_cast<std::uint64_t>(n_corners) > size - place - 1) {
        source_.fail(fmt::format("{}: cell {} does not fit into the {} numbers that there are",
                                 label, cell, size));
      }
      const auto first = values.begin() + static_cast<std::ptrdiff_t>(place) + 1;
      corners_.insert(corners_.end(), first, first + n_corners);
      ends.push_back(static_cast<std::int64_t>(corners_.size()));
      place += static_cast<std::uint64_t>(n_corners) + 1;
    }
    if (place != size) {
      source_.fail(fmt::format("{} take {} numbers, but there are {}", label, place, size));
    }
    return ends;
  }

  static std::vector<std::int64_t> whole_values(const VtpArray& array) {
    std::vector<std::int64_t> result(n_values(array));
    for (std::size_t k = 0; k < result.size(); ++k) result[k] = number<std::int64_t>(array, k);
    return result;
  }

  /// The next word, a type that points and corners can have.
  std::string number_type() {
    std::string type = source_.keyword("a type");
    const std::string xml_type = vtk_type_of_legacy(type);
    if (xml_type.empty() || xml_type == "String") unexpected("a type of numbers", type);
    return type;
  }

  VtpArray read_array(const std::string& type, std::uint64_t n_components, std::uint64_t n_rows,
                      const std::string& label) {
    // Neither is above 2^31.
    VtpArray array{.type = vtk_type_of_legacy(type), .n_components = n_components, .bytes = {}};
    array.bytes = source_.values(type, n_components * n_rows, label);
    return array;
  }

  /// Values of cells or points.
  void read_attribute(const std::string& key) {
    if (key == "cell_data" || key == "point_data") {
      is_of_points_ = key == "point_data";
      n_rows_ = source_.count("the number of " + std::string(is_of_points_ ? "points" : "cells"));
      if (!is_of_points_ && n_rows_ != file_.n_polygons + file_.n_other_cells) {
        source_.fail(fmt::format("has values of {} cells, but {} cells", n_rows_,
                                 file_.n_polygons + file_.n_other_cells));
      }
    } else if (key == "metadata") {
      skip_metadata();
    } else if (key == "field") {
      read_field(file_.cells, n_rows_);
    } else if (key == "lookup_table") {
      source_.word("the name of a table");
      // Four bytes each; as text, fractions.
      read_array(source_.is_binary() ? "unsigned_char" : "float", 4,
                 source_.count("the size of a table"), "a table of colours");
    } else {
      read_values(key);
    }
  }

  /// Up to the next empty line.
  void skip_metadata() {
    source_.line();
    while (!source_.is_at_end() && !is_blank(source_.line())) {
    }
  }

  static bool is_blank(std::string_view line) {
    return line.find_first_not_of(" \t\r") == std::string_view::npos;
  }

  void read_values(const std::string& key) {
    static const std::map<std::string, std::uint64_t> kComponents = {
        {"vectors", 3},    {"normals", 3},      {"tensors", 9},   {"tensors6", 6},
        {"global_ids", 1}, {"pedigree_ids", 1}, {"edge_flags", 1}};
    const bool is_known = kComponents.contains(key) || key == "scalars" || key == "color_scalars" ||
                          key == "texture_coordinates";
    if (!is_known) source_.fail(fmt::format("found {}, expected a keyword", in_quotes(key)));
    const std::string name = source_.name("a name");
    const std::string label = "the values " + in_quotes(name);
    std::uint64_t n_components = 1;
    std::string type = source_.is_binary() ? "unsigned_char" : "float";
    if (kComponents.contains(key)) {
      n_components = kComponents.at(key);
    } else if (key != "scalars") {
      n_components = source_.count("a number of columns");
    }
    if (key != "color_scalars") type = source_.keyword("a type");
    if (key == "scalars") n_components = read_scalars_head();
    keep(name, read_array(type, n_components, n_rows_, label));
  }

  /// The rest of the line, which may have a number of columns, and the line that names a table.
  std::uint64_t read_scalars_head() {
    std::uint64_t n_components = 1;
    if (!is_blank(source_.rest_of_line())) n_components = source_.count("a number of columns");
    const std::string key = source_.keyword("LOOKUP_TABLE");
    if (key != "lookup_table") unexpected("LOOKUP_TABLE", key);
    source_.word("the name of a table");
    return n_components;
  }

  void read_field(VtpFile::Arrays& arrays, std::optional<std::uint64_t> n_wanted) {
    source_.word("the name of the field");
    const std::uint64_t n = source_.count("a number of arrays");
    for (std::uint64_t k = 0; k < n; ++k) {
      std::string name = source_.name("the name of an array");
      while (name == "METADATA") {  // of the array before
        skip_metadata();
        name = source_.name("the name of an array");
      }
      const std::string label = "the array " + in_quotes(name);
      const std::uint64_t n_components = source_.count("a number of columns");
      const std::uint64_t n_rows = source_.count("a number of rows");
      if (n_wanted && n_rows != *n_wanted) {
        source_.fail(fmt::format("{} has {} rows, expected {}", label, n_rows, *n_wanted));
      }
      VtpArray array = read_array(source_.keyword("a type"), n_components, n_rows, label);
      if (&arrays == &file_.fields) {
        if (!array.type.empty()) arrays[name] = std::move(array);
      } else {
        keep(name, std::move(array));
      }
    }
  }

  /// Values of cells, but no bits.
  void keep(const std::string& name, VtpArray&& array) {
    if (is_of_points_ || array.type.empty() || array.n_components == 0) return;
    if (!file_.cells.try_emplace(name, std::move(array)).second) {
      source_.fail(fmt::format("the array {} is there twice", in_quotes(name)));
    }
  }

  void check() const {
    if (file_.kind == VtkKind::unstructured && n_types_ != file_.n_polygons) {
      source_.fail(fmt::format("has {} cells, but types of {}", file_.n_polygons, n_types_));
    }
    for (const auto& [name, values] : file_.cells) {
      const std::uint64_t n_rows = file_.n_polygons + file_.n_other_cells;
      if (values.type != "String" && n_values(values) != n_rows * values.n_components) {
        source_.fail("has cells behind the values of cells");
      }
    }
  }

  VtkLegacySource source_;
  VtpFile file_;
  std::vector<std::int64_t> corners_;  // of the cells last read
  std::uint64_t n_types_ = 0;
  std::uint64_t n_rows_ = 0;  // of values of cells or points, whichever these are
  bool is_of_points_ = false;
};

}  // namespace

VtpFile read_vtk_legacy(const std::filesystem::path& path) { return LegacyReader(path).read(); }

}  // namespace io
