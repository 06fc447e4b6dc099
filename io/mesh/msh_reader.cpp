#include "io/mesh/msh_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "io/base/line_reader.h"
#include "io/mesh/surface_index.h"

namespace io {
namespace {

using radiosity::Scene;

/// Dimension of a surface among Gmsh's entities.
constexpr std::int64_t kSurface = 2;

/// Corners of a cell of Gmsh's type, 0 if it is no triangle or quad.
int corners_of_type(std::int64_t type) {
  switch (type) {
    case 2:   // of 3 nodes
    case 9:   // 6
    case 20:  // 9
    case 21:  // 10
    case 22:  // 12
    case 23:  // 15
      return 3;
    case 3:   // of 4 nodes
    case 10:  // 9
    case 16:  // 8
    case 36:  // 16
      return 4;
    default:
      return 0;
  }
}

class MshReader {
 public:
  MshReader(const std::filesystem::path& path, const radiosity::Progress& progress)
      : lines_(path, progress), surfaces_(scene_, path.stem().string()) {}

  FileScene read() {
    read_format();
    bool has_nodes = false;
    while (next_section()) {
      if (section_ == "PhysicalNames") read_physical_names();
      if (section_ == "Entities") read_entities();
      if (section_ == "Nodes") {
        is_old() ? read_nodes() : read_node_blocks();
        has_nodes = true;
      }
      if (section_ == "Elements") {
        if (!has_nodes) lines_.fail("has elements before its nodes");
        is_old() ? read_elements() : read_element_blocks();
      }
      leave_section();
    }
    if (scene_.n_polygons() == 0 && n_left_out_ > 0) {
      lines_.fail(fmt::format(
          "has no triangles or quads, but {} other cells: save the surface mesh, too (in Gmsh, a "
          "physical group of surfaces)",
          n_left_out_));
    }
    return {std::move(scene_), {}};
  }

 private:
  [[nodiscard]] bool is_old() const { return version_ < 3; }

  /// The next line of the section, which must be there.
  Words next() {
    if (!lines_.next_line()) lines_.fail(fmt::format("file ends in ${}", section_));
    return Words(lines_.line());
  }

  std::int64_t count(Words& words, std::string_view what) {
    const std::int64_t n = lines_.integer(words, what);
    if (n < 0) lines_.fail(fmt::format("found {} as {}, expected 0 or more", n, what));
    return n;
  }

  void read_format() {
    if (!next_section() || section_ != "MeshFormat") {
      lines_.fail("is no mesh of Gmsh: expected $MeshFormat");
    }
    lines_.recognise();
    Words words = next();
    version_ = lines_.number(words, "the version");
    const bool is_known = (version_ >= 2 && version_ < 3) || (version_ >= 4.1 && version_ < 5);
    if (!is_known) {
      lines_.fail(
          fmt::format("has version {:g}, expected 2 or 4.1 (gmsh -format msh41)", version_));
    }
    if (lines_.integer(words, "the kind of file") != 0) {
      lines_.fail("is binary, expected text (in Gmsh, Mesh.Binary = 0)");
    }
    leave_section();
  }

  bool next_section() {
    while (lines_.next_line()) {
      const std::string_view line = trimmed(lines_.line());
      if (line.starts_with('$')) {
        section_ = line.substr(1);
        return true;
      }
      if (!line.empty()) lines_.fail("expected $ and the name of a section");
    }
    return false;
  }

  void leave_section() {
    while (trimmed(lines_.line()) != "$End" + section_) {
      if (!lines_.next_line()) lines_.fail(fmt::format("file ends in ${}", section_));
    }
  }

  void read_physical_names() {
    Words head = next();
    for (std::int64_t n = count(head, "the number of names"); n > 0; --n) {
      Words words = next();
      const std::int64_t dimension = lines_.integer(words, "a dimension");
      const std::int64_t tag = lines_.integer(words, "a number");
      std::string_view name = words.rest();
      if (name.size() >= 2 && name.front() == '"' && name.back() == '"') {
        name = name.substr(1, name.size() - 2);
      }
      if (dimension == kSurface) names_[std::abs(tag)] = name;
    }
  }

  /// The physical groups of the surfaces.
  void read_entities() {
    Words head = next();
    std::array<std::int64_t, 4> n{};
    for (std::int64_t& each : n) each = count(head, "a number of entities");
    for (std::int64_t k = n[0] + n[1]; k > 0; --k) next();
    for (std::int64_t k = n[2]; k > 0; --k) {
      Words words = next();
      const std::int64_t tag = lines_.integer(words, "an entity");
      for (int side = 0; side < 6; ++side) lines_.number(words, "a side of its box");
      const std::int64_t n_groups = count(words, "its number of groups");
      if (n_groups > 0) group_of_[tag] = lines_.integer(words, "a group");
    }
  }

  void add_node(std::int64_t tag, const radiosity::Vec3& point) {
    const auto place = static_cast<std::int32_t>(scene_.vertices.size());
    if (!nodes_.emplace(tag, place).second) lines_.fail(fmt::format("node {} stands twice", tag));
    scene_.vertices.push_back(point);
  }

  void read_nodes() {
    Words head = next();
    for (std::int64_t n = count(head, "the number of nodes"); n > 0; --n) {
      Words words = next();
      const std::int64_t tag = lines_.integer(words, "a node");
      add_node(tag, lines_.point(words));
    }
  }

  void read_node_blocks() {
    Words head = next();
    std::vector<std::int64_t> tags;
    for (std::int64_t n = count(head, "the number of blocks"); n > 0; --n) {
      Words block = next();
      lines_.integer(block, "a dimension");
      lines_.integer(block, "an entity");
      lines_.integer(block, "whether nodes have parameters");
      tags.clear();
      for (std::int64_t k = count(block, "a number of nodes"); k > 0; --k) {
        Words words = next();
        tags.push_back(lines_.integer(words, "a node"));
      }
      for (const std::int64_t tag : tags) {
        Words words = next();
        add_node(tag, lines_.point(words));
      }
    }
  }

  void read_elements() {
    Words head = next();
    for (std::int64_t n = count(head, "the number of elements"); n > 0; --n) {
      Words words = next();
      lines_.integer(words, "an element");
      const std::int64_t type = lines_.integer(words, "its type");
      std::int64_t group = 0;
      std::int64_t entity = 0;
      const std::int64_t n_tags = count(words, "its number of tags");
      for (std::int64_t k = 0; k < n_tags; ++k) {
        const std::int64_t tag = lines_.integer(words, "a tag");
        if (k == 0) group = tag;
        if (k == 1) entity = tag;
      }
      add_element(type, group, entity, words);
    }
  }

  void read_element_blocks() {
    Words head = next();
    for (std::int64_t n = count(head, "the number of blocks"); n > 0; --n) {
      Words block = next();
      lines_.integer(block, "a dimension");
      const std::int64_t entity = lines_.integer(block, "an entity");
      const std::int64_t type = lines_.integer(block, "a type");
      const auto group = group_of_.find(entity);
      for (std::int64_t k = count(block, "a number of elements"); k > 0; --k) {
        Words words = next();
        lines_.integer(words, "an element");
        add_element(type, group == group_of_.end() ? 0 : group->second, entity, words);
      }
    }
  }

  /// `words` are the rest of its line, the nodes.
  void add_element(std::int64_t type, std::int64_t group, std::int64_t entity, Words& words) {
    const int n = corners_of_type(type);
    if (n == 0) {
      ++n_left_out_;
      return;
    }
    std::array<std::int32_t, 4> corners{};
    for (int k = 0; k < n; ++k) {
      const std::int64_t node = lines_.integer(words, "a node");
      const auto found = nodes_.find(node);
      if (found == nodes_.end()) lines_.fail(fmt::format("node {} is not there", node));
      corners[k] = found->second;
    }
    // Turned round in the group.
    if (group < 0) std::reverse(corners.begin(), corners.begin() + n);
    scene_.add_polygon(std::span(corners).first(n), surface(std::abs(group), entity));
  }

  std::int32_t surface(std::int64_t group, std::int64_t entity) {
    if (last_surface_ >= 0 && group == last_group_ && entity == last_entity_) return last_surface_;
    const auto named = names_.find(group);
    std::string name = named != names_.end() ? named->second
                       : group != 0          ? fmt::format("group {}", group)
                                             : fmt::format("surface {}", entity);
    last_group_ = group;
    last_entity_ = entity;
    return last_surface_ = surfaces_.find_or_add(name, -1);
  }

  LineReader lines_;
  Scene scene_;
  SurfaceIndex surfaces_;
  double version_ = 0;
  std::string section_;
  std::map<std::int64_t, std::string> names_;      // of physical groups of surfaces
  std::map<std::int64_t, std::int64_t> group_of_;  // by surface entity; negative: turned round
  std::unordered_map<std::int64_t, std::int32_t> nodes_;
  std::int64_t n_left_out_ = 0;  // cells
  std::int64_t last_group_ = 0;
  std::int64_t last_entity_ = 0;
  std::int32_t last_surface_ = -1;  // none yet
};

}  // namespace

FileScene read_msh(const std::filesystem::path& path, const radiosity::Progress& progress) {
  return MshReader(path, progress).read();
}

}  // namespace io
