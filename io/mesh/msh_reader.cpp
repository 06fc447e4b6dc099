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

#include "io/mesh/msh_source.h"
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

/// Nodes of a cell of Gmsh's type, from 1 on; 0 if there is no such type.
constexpr std::array<int, 110> kNodesOfTypes = {
    2,   3,   4,    4,  8,  6,  5,  3,  6,  9,  10,  27,  18,  14,  1,   8,   20,  15,  13,
    0,   10,  0,    15, 0,  21, 4,  5,  6,  20, 35,  56,  0,   0,   0,   0,   16,  25,  36,
    0,   0,   0,    28, 36, 45, 55, 66, 49, 64, 81,  100, 121, 0,   0,   0,   0,   0,   0,
    0,   0,   0,    0,  7,  8,  9,  10, 11, 0,  0,   0,   0,   84,  120, 165, 220, 286, 0,
    0,   0,   0,    0,  0,  0,  0,  0,  0,  0,  0,   0,   0,   40,  75,  64,  125, 216, 343,
    512, 729, 1000, 0,  0,  0,  0,  0,  0,  0,  126, 196, 288, 405, 550};

class MshReader {
 public:
  MshReader(const std::filesystem::path& path, const radiosity::Progress& progress)
      : source_(path, progress), surfaces_(scene_, path.stem().string()) {}

  FileScene read() {
    bool has_nodes = false;
    while (source_.next_section()) {
      const std::string& section = source_.section();
      if (section == "PhysicalNames") read_physical_names();
      if (section == "Entities") read_entities();
      if (section == "Nodes" || section == "ParametricNodes") {
        is_old() ? read_nodes() : read_node_blocks();
        has_nodes = true;
      }
      if (section == "Elements") {
        if (!has_nodes) source_.fail("has elements before its nodes");
        is_old() ? read_elements() : read_element_blocks();
      }
      source_.leave_section();
    }
    if (scene_.n_polygons() == 0 && n_left_out_ > 0) {
      source_.fail(fmt::format(
          "has no triangles or quads, but {} other cells: save the surface mesh, too (in Gmsh, a "
          "physical group of surfaces)",
          n_left_out_));
    }
    return {std::move(scene_), {}};
  }

 private:
  [[nodiscard]] bool is_old() const { return source_.version() < 3; }

  /// As text in binary files, too.
  void read_physical_names() {
    Words head = source_.next_line();
    for (std::uint64_t n = source_.count(head, "the number of names", 1); n > 0; --n) {
      Words words = source_.next_line();
      const std::int64_t dimension = source_.integer(words, "a dimension");
      const std::int64_t tag = source_.integer(words, "a number");
      std::string_view name = words.rest();
      if (name.size() >= 2 && name.front() == '"' && name.back() == '"') {
        name = name.substr(1, name.size() - 2);
      }
      if (dimension == kSurface) names_[std::abs(tag)] = name;
    }
  }

  /// The physical groups of the surfaces.
  void read_entities() {
    source_.next_record();
    std::array<std::uint64_t, 4> n{};
    for (std::uint64_t& each : n) each = source_.count("a number of entities", 8);
    for (std::uint64_t k = n[0]; k > 0; --k) skip_entity(3, 1);
    for (std::uint64_t k = n[1]; k > 0; --k) skip_entity(6, 2);
    for (std::uint64_t k = n[2]; k > 0; --k) {
      source_.next_record();
      const std::int64_t tag = source_.integer("an entity");
      for (int side = 0; side < 6; ++side) source_.number("a side of its box");
      const std::uint64_t n_groups = source_.count("its number of groups", 4);
      for (std::uint64_t g = 0; g < n_groups; ++g) {
        const std::int64_t group = source_.integer("a group");
        if (g == 0) group_of_[tag] = group;
      }
      if (source_.is_binary()) skip_list();
    }
  }

  /// A point or curve: its number, coordinates, and lists of groups and of what bounds it.
  void skip_entity(int n_coordinates, int n_lists) {
    source_.next_record();
    if (!source_.is_binary()) return;
    source_.integer("an entity");
    for (int k = 0; k < n_coordinates; ++k) source_.number("a coordinate");
    for (int k = 0; k < n_lists; ++k) skip_list();
  }

  void skip_list() {
    for (std::uint64_t k = source_.count("the length of a list", 4); k > 0; --k) {
      source_.integer("an item of a list");
    }
  }

  void add_node(std::int64_t tag, const radiosity::Vec3& point) {
    const auto place = static_cast<std::int32_t>(scene_.vertices.size());
    if (!nodes_.emplace(tag, place).second) source_.fail(fmt::format("node {} stands twice", tag));
    scene_.vertices.push_back(point);
  }

  void read_nodes() {
    const bool is_parametric = source_.section() == "ParametricNodes";
    Words head = source_.next_line();
    constexpr int kBytes = 28;
    for (std::uint64_t n = source_.count(head, "the number of nodes", kBytes); n > 0; --n) {
      source_.next_record();
      const std::int64_t tag = source_.integer("a node");
      add_node(tag, source_.point());
      if (!source_.is_binary() || !is_parametric) continue;
      const std::int64_t dimension = source_.integer("a dimension");
      source_.integer("an entity");
      // Nodes in volumes have none in this version.
      skip_parameters(dimension == 3 ? 0 : dimension);
    }
  }

  /// Of a binary node, as many as what it lies on has dimensions.
  void skip_parameters(std::int64_t dimension) {
    if (dimension < 0 || dimension > 3) source_.fail(fmt::format("has dimension {}", dimension));
    for (std::int64_t k = 0; k < dimension; ++k) source_.number("a parameter");
  }

  void read_node_blocks() {
    source_.next_record();
    std::vector<std::int64_t> tags;
    const std::uint64_t n_blocks = source_.count("the number of blocks", 20);
    if (source_.is_binary()) skip_totals();
    for (std::uint64_t n = n_blocks; n > 0; --n) {
      source_.next_record();
      const std::int64_t dimension = source_.integer("a dimension");
      source_.integer("an entity");
      const bool is_parametric = source_.integer("whether nodes have parameters") != 0;
      tags.clear();
      for (std::uint64_t k = source_.count("a number of nodes", 32); k > 0; --k) {
        source_.next_record();
        tags.push_back(source_.large("a node"));
      }
      for (const std::int64_t tag : tags) {
        source_.next_record();
        add_node(tag, source_.point());
        if (source_.is_binary() && is_parametric) skip_parameters(dimension);
      }
    }
  }

  /// The number of all nodes or elements, the least and the largest of their numbers.
  void skip_totals() {
    for (int k = 0; k < 3; ++k) source_.large("a number of all blocks");
  }

  void read_elements() {
    Words head = source_.next_line();
    std::uint64_t n = source_.count(head, "the number of elements", 8);
    while (n > 0) {
      // Binary elements of one type follow its number.
      std::uint64_t n_alike = 1;
      std::int64_t type = 0;
      std::int64_t n_tags = 0;
      source_.next_record();
      if (source_.is_binary()) {
        type = source_.integer("a type");
        const std::int64_t found = source_.integer("a number of elements");
        n_tags = source_.integer("their number of tags");
        if (found < 1 || static_cast<std::uint64_t>(found) > n) {
          source_.fail(
              fmt::format("found {} elements of type {}, expected 1 to {}", found, type, n));
        }
        n_alike = static_cast<std::uint64_t>(found);
      }
      for (std::uint64_t k = 0; k < n_alike; ++k) {
        source_.integer("an element");
        if (!source_.is_binary()) {
          type = source_.integer("its type");
          n_tags = source_.integer("its number of tags");
        }
        read_element(type, n_tags);
      }
      n -= n_alike;
    }
  }

  /// From its tags on.
  void read_element(std::int64_t type, std::int64_t n_tags) {
    if (n_tags < 0) source_.fail(fmt::format("found {} as a number of tags", n_tags));
    std::int64_t group = 0;
    std::int64_t entity = 0;
    for (std::int64_t k = 0; k < n_tags; ++k) {
      const std::int64_t tag = source_.integer("a tag");
      if (k == 0) group = tag;
      if (k == 1) entity = tag;
    }
    add_element(type, group, entity);
  }

  void read_element_blocks() {
    source_.next_record();
    const std::uint64_t n_blocks = source_.count("the number of blocks", 20);
    if (source_.is_binary()) skip_totals();
    for (std::uint64_t n = n_blocks; n > 0; --n) {
      source_.next_record();
      source_.integer("a dimension");
      const std::int64_t entity = source_.integer("an entity");
      const std::int64_t type = source_.integer("a type");
      const auto group = group_of_.find(entity);
      for (std::uint64_t k = source_.count("a number of elements", 16); k > 0; --k) {
        source_.next_record();
        source_.large("an element");
        add_element(type, group == group_of_.end() ? 0 : group->second, entity);
      }
    }
  }

  std::int64_t node() { return is_old() ? source_.integer("a node") : source_.large("a node"); }

  /// The rest of its record are the nodes, of which text need not be read to the end.
  void add_element(std::int64_t type, std::int64_t group, std::int64_t entity) {
    const int n = corners_of_type(type);
    std::array<std::int32_t, 4> corners{};
    for (int k = 0; k < n; ++k) {
      const std::int64_t tag = node();
      const auto found = nodes_.find(tag);
      if (found == nodes_.end()) source_.fail(fmt::format("node {} is not there", tag));
      corners[k] = found->second;
    }
    if (source_.is_binary()) {
      for (int k = n; k < nodes_of_type(type); ++k) node();
    }
    if (n == 0) {
      ++n_left_out_;
      return;
    }
    // Turned round in the group.
    if (group < 0) std::reverse(corners.begin(), corners.begin() + n);
    scene_.add_polygon(std::span(corners).first(n), surface(std::abs(group), entity));
  }

  [[nodiscard]] int nodes_of_type(std::int64_t type) const {
    const bool is_known = type >= 1 && type <= std::ssize(kNodesOfTypes);
    const int n = is_known ? kNodesOfTypes[static_cast<std::size_t>(type - 1)] : 0;
    if (n == 0) source_.fail(fmt::format("has cells of type {}, which is not known", type));
    return n;
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

  MshSource source_;
  Scene scene_;
  SurfaceIndex surfaces_;
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
