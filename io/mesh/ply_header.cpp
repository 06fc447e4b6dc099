#include "io/mesh/ply_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "io/mesh/file_scene.h"

namespace io {
namespace {

struct TypeName {
  std::string_view name;
  PlyType type;
};

constexpr std::array<TypeName, 16> kTypeNames = {{{"char", PlyType::int8},
                                                  {"int8", PlyType::int8},
                                                  {"uchar", PlyType::uint8},
                                                  {"uint8", PlyType::uint8},
                                                  {"short", PlyType::int16},
                                                  {"int16", PlyType::int16},
                                                  {"ushort", PlyType::uint16},
                                                  {"uint16", PlyType::uint16},
                                                  {"int", PlyType::int32},
                                                  {"int32", PlyType::int32},
                                                  {"uint", PlyType::uint32},
                                                  {"uint32", PlyType::uint32},
                                                  {"float", PlyType::float32},
                                                  {"float32", PlyType::float32},
                                                  {"double", PlyType::float64},
                                                  {"float64", PlyType::float64}}};

bool is_integer(PlyType type) { return type != PlyType::float32 && type != PlyType::float64; }

PlyType read_type(const LineReader& lines, Words& words) {
  const auto name = words.next();
  const auto* const entry =
      std::find_if(kTypeNames.begin(), kTypeNames.end(),
                   [&](const TypeName& candidate) { return candidate.name == name; });
  if (entry == kTypeNames.end()) {
    lines.fail(
        fmt::format("unknown type \"{}\", expected char, uchar, short, ushort, int, uint, "
                    "float or double",
                    name));
  }
  return entry->type;
}

PlyFormat read_format(const LineReader& lines, Words& words) {
  const auto name = words.next();
  if (name == "ascii") return PlyFormat::ascii;
  if (name == "binary_little_endian") return PlyFormat::little_endian;
  if (name == "binary_big_endian") return PlyFormat::big_endian;
  lines.fail(
      fmt::format("unknown format \"{}\", expected ascii, binary_little_endian or "
                  "binary_big_endian",
                  name));
}

PlyElement read_element(const LineReader& lines, Words& words) {
  PlyElement element;
  element.name = words.next();
  if (element.name == "vertex") element.kind = PlyElement::Kind::vertex;
  if (element.name == "face") element.kind = PlyElement::Kind::face;
  element.count = lines.integer(words, "the number of elements");
  if (element.count < 0) {
    lines.fail(fmt::format("found {} elements, expected no negative number", element.count));
  }
  return element;
}

PlyProperty::Role role(PlyElement::Kind kind, std::string_view name) {
  if (kind == PlyElement::Kind::vertex && name == "x") return PlyProperty::Role::x;
  if (kind == PlyElement::Kind::vertex && name == "y") return PlyProperty::Role::y;
  if (kind == PlyElement::Kind::vertex && name == "z") return PlyProperty::Role::z;
  if (kind == PlyElement::Kind::face && (name == "vertex_indices" || name == "vertex_index")) {
    return PlyProperty::Role::indices;
  }
  return PlyProperty::Role::skipped;
}

PlyProperty read_property(const LineReader& lines, Words words, PlyElement::Kind kind) {
  PlyProperty property;
  if (Words(words).next() == "list") {
    words.next();
    property.count_type = read_type(lines, words);
    if (!is_integer(*property.count_type)) lines.fail("a list's length must have an integer type");
  }
  property.type = read_type(lines, words);
  const auto name = words.next();
  property.role = role(kind, name);
  const bool must_be_list = property.role == PlyProperty::Role::indices;
  if (property.role != PlyProperty::Role::skipped &&
      must_be_list != property.count_type.has_value()) {
    lines.fail(fmt::format("\"{}\" must {} a list", name, must_be_list ? "be" : "not be"));
  }
  if (must_be_list && !is_integer(property.type)) {
    lines.fail(fmt::format("\"{}\" must have an integer type", name));
  }
  return property;
}

int count_role(const PlyElement& element, PlyProperty::Role wanted) {
  return static_cast<int>(
      std::count_if(element.properties.begin(), element.properties.end(),
                    [&](const PlyProperty& property) { return property.role == wanted; }));
}

void check_elements(const LineReader& lines, PlyHeader& header) {
  int n_vertex_elements = 0;
  int n_face_elements = 0;
  for (const PlyElement& element : header.elements) {
    if (element.properties.empty()) {
      lines.fail(fmt::format("element \"{}\" has no properties", element.name));
    }
    if (element.kind == PlyElement::Kind::vertex) {
      ++n_vertex_elements;
      header.n_vertices = element.count;
      for (const PlyProperty::Role axis :
           {PlyProperty::Role::x, PlyProperty::Role::y, PlyProperty::Role::z}) {
        if (count_role(element, axis) != 1) lines.fail("vertices need one x, one y and one z each");
      }
    } else if (element.kind == PlyElement::Kind::face) {
      ++n_face_elements;
      if (count_role(element, PlyProperty::Role::indices) != 1)
        lines.fail("faces need one vertex_indices list");
    }
  }
  if (n_vertex_elements != 1 || n_face_elements != 1) {
    lines.fail(fmt::format("expected one vertex and one face element, found {} and {}",
                           n_vertex_elements, n_face_elements));
  }
}

}  // namespace

std::uint64_t ply_size(PlyType type) {
  switch (type) {
    case PlyType::int8:
    case PlyType::uint8:
      return 1;
    case PlyType::int16:
    case PlyType::uint16:
      return 2;
    case PlyType::int32:
    case PlyType::uint32:
    case PlyType::float32:
      return 4;
    case PlyType::float64:
      break;
  }
  return 8;
}

PlyHeader read_ply_header(const std::filesystem::path& path, LineReader& lines) {
  PlyHeader header;
  RepairCount unknown;
  if (!lines.next_line() || trimmed(lines.line()) != "ply") {
    lines.fail("expected \"ply\" on the first line");
  }
  lines.recognise();
  bool has_format = false;
  while (lines.next_line()) {
    Words words(lines.line());
    const auto keyword = words.next();
    if (keyword == "end_header") {
      if (!has_format) lines.fail("the header has no format");
      check_elements(lines, header);
      unknown.report("the line is left out", header.repairs);
      return header;
    }
    if (keyword == "format") {
      header.format = read_format(lines, words);
      has_format = true;
    } else if (keyword == "element") {
      header.elements.push_back(read_element(lines, words));
    } else if (keyword == "property") {
      if (header.elements.empty()) lines.fail("property stands before any element");
      auto& element = header.elements.back();
      element.properties.push_back(read_property(lines, words, element.kind));
    } else if (!keyword.empty() && keyword != "comment" && keyword != "obj_info") {
      // A comment that was broken into lines, as some programs write.
      unknown.add(fmt::format("{}:{}", path.string(), lines.line_number()),
                  fmt::format("unknown header keyword {}", lines.shown(keyword)));
    }
  }
  lines.fail("file ends before \"end_header\"");
}

}  // namespace io
