#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "radiosity/compressed/compressed_blocks.h"

namespace radiosity {

CompressedMatrix::Entry CompressedMatrix::entry(Index row, Index column) const {
  const auto& nodes = blocks_.basis.nodes;
  const float* numbers = blocks_.basis.numbers.data();
  if (row > column) std::swap(row, column);
  /// The nodes that hold a row, from the root down, and their functions there.
  struct Path {
    std::vector<std::int32_t> nodes;
    std::vector<std::vector<double>> values;
  };
  const auto find_path = [&](Index at) {
    Path path;
    std::int32_t k = 0;
    while (true) {
      path.nodes.push_back(k);
      if (nodes[k].is_leaf()) break;
      k = at < nodes[nodes[k].left].end ? nodes[k].left : nodes[k].right;
    }
    path.values.resize(path.nodes.size());
    const NestedBasis::Node& leaf = nodes[k];
    const float* value = numbers + leaf.values + (at - leaf.begin) * leaf.used;
    path.values.back().assign(value, value + leaf.used);
    for (std::size_t level = path.nodes.size() - 1; level > 0; --level) {
      const NestedBasis::Node& node = nodes[path.nodes[level]];
      const NestedBasis::Node& above = nodes[path.nodes[level - 1]];
      const float* transfer = numbers + node.transfer;
      path.values[level - 1].assign(above.used, 0.0);
      for (int f = 0; f < above.used; ++f) {
        for (int g = 0; g < node.used; ++g) {
          path.values[level - 1][f] += *transfer++ * path.values[level][g];
        }
      }
    }
    return path;
  };
  const Path path = find_path(row);
  const Path other = find_path(column);
  const auto level_of = [&](std::int32_t node) -> std::ptrdiff_t {
    const auto found = std::find(other.nodes.begin(), other.nodes.end(), node);
    return found == other.nodes.end() ? -1 : found - other.nodes.begin();
  };
  for (std::size_t level = 0; level < path.nodes.size(); ++level) {
    const std::int32_t k = path.nodes[level];
    for (std::int64_t u = far_.first[k]; u < far_.first[k + 1]; ++u) {
      const Use use = far_.at(u);
      const std::ptrdiff_t at = level_of(use.other);
      if (at < 0) continue;
      const auto& of_a = use.is_a ? path.values[level] : other.values[at];
      const auto& of_b = use.is_a ? other.values[at] : path.values[level];
      double sum = 0;
      const float* coefficient = &blocks_.coefficients[use.first];
      for_each_function(nodes[use.is_a ? k : use.other].counts,
                        nodes[use.is_a ? use.other : k].counts, use.degrees, [&](int f, int count) {
                          for (int g = 0; g < count; ++g) {
                            sum += *coefficient++ * (of_a[f] * of_b[g]);
                          }
                        });
      return {sum, use.error, use.may_change};
    }
  }
  const std::int32_t k = path.nodes.back();
  for (std::int64_t u = near_.first[k]; u < near_.first[k + 1]; ++u) {
    const Use use = near_.at(u);
    if (use.other != other.nodes.back()) continue;
    const NestedBasis::Node& a = nodes[use.is_a ? k : use.other];
    const NestedBasis::Node& b = nodes[use.is_a ? use.other : k];
    const Index in_a = (use.is_a ? row : column) - a.begin;
    const Index in_b = (use.is_a ? column : row) - b.begin;
    return {blocks_.densities[use.first + in_a * (b.end - b.begin) + in_b], use.error,
            use.may_change};
  }
  return {};
}

}  // namespace radiosity
