#include "radiosity/compressed/stored_blocks.h"

#include <cmath>
#include <string>
#include <utility>

#include "radiosity/base/error.h"

namespace radiosity {
namespace {

using Node = NestedBasis::Node;

[[noreturn]] void refuse(const std::string& what, std::size_t number, const std::string& why) {
  throw SolveError(what + " " + std::to_string(number) + " " + why);
}

void require_length(std::size_t found, std::size_t expected, const std::string& what) {
  if (found == expected) return;
  throw SolveError("has " + std::to_string(found) + " " + what + ", expected " +
                   std::to_string(expected));
}

/// Appends n values from where a block has them.
void append(const std::vector<float>& from, std::uint64_t first, std::uint64_t n,
            std::vector<float>& to) {
  const auto begin = from.begin() + static_cast<std::ptrdiff_t>(first);
  to.insert(to.end(), begin, begin + static_cast<std::ptrdiff_t>(n));
}

std::uint64_t n_densities(const Node& a, const Node& b) {
  return static_cast<std::uint64_t>(a.end - a.begin) * static_cast<std::uint64_t>(b.end - b.begin);
}

std::uint64_t n_far_coefficients(const std::vector<Node>& nodes, const CompressedBlocks::Far& far) {
  return static_cast<std::uint64_t>(
      n_coefficients(nodes[far.a].counts, nodes[far.b].counts, far.degrees));
}

/// Nodes stand before those below them, the left one and all of its first, and divide their rows.
void check_tree(const std::vector<Node>& nodes, Index n_rows) {
  if (nodes.empty() || nodes[0].begin != 0 || nodes[0].end != n_rows) {
    throw SolveError("has no tree of its " + std::to_string(n_rows) + " patches");
  }
  const auto n = static_cast<std::int32_t>(nodes.size());
  std::vector<std::int32_t> after(nodes.size());  // those below each
  for (std::int32_t k = n - 1; k >= 0; --k) {
    const Node& node = nodes[k];
    after[k] = k + 1;
    const bool has_rows = 0 <= node.begin && node.begin < node.end && node.end <= n_rows;
    if (has_rows && node.left == -1 && node.right == -1) continue;
    const bool is_parent =
        has_rows && node.left == k + 1 && node.left < n && node.right == after[node.left] &&
        node.right < n && nodes[node.left].begin == node.begin &&
        nodes[node.left].end == nodes[node.right].begin && nodes[node.right].end == node.end;
    if (!is_parent) refuse("node", k, "does not fit into its tree");
    after[k] = after[node.right];
  }
  if (after[0] != n) throw SolveError("has nodes that are not in its tree");
}

void check_functions(const Node& node, std::size_t k) {
  if (node.counts[0] != 1 || node.used == 0) {
    refuse("node", k, "has other functions of degree 0 than one");
  }
  for (std::size_t degree = 1; degree < node.counts.size(); ++degree) {
    if (node.counts[degree] < node.counts[degree - 1]) {
      refuse("node", k, "has fewer functions of a higher degree");
    }
  }
}

/// Tells each node where its functions and numbers are; returns how many numbers there are.
std::uint64_t place_numbers(NestedBasis& basis) {
  std::vector<std::int32_t> parent(basis.nodes.size(), -1);
  std::uint64_t size = 0;
  for (std::size_t k = 0; k < basis.nodes.size(); ++k) {
    Node& node = basis.nodes[k];
    node.first = basis.n_functions;
    basis.n_functions += node.used;
    if (parent[k] >= 0) {
      node.transfer = size;
      size += std::uint64_t{basis.nodes[parent[k]].used} * node.used;
    }
    if (node.is_leaf()) {
      node.values = size;
      size += static_cast<std::uint64_t>(node.end - node.begin) * node.used;
    } else {
      parent[node.left] = parent[node.right] = static_cast<std::int32_t>(k);
    }
  }
  return size;
}

NestedBasis restore_basis(StoredBlocks& stored, Index n_rows) {
  NestedBasis basis;
  basis.nodes.resize(stored.nodes.size() / kNodeWidth);
  require_length(stored.functions.size(), basis.nodes.size() * kFunctionWidth,
                 "numbers of functions");
  for (std::size_t k = 0; k < basis.nodes.size(); ++k) {
    Node& node = basis.nodes[k];
    const std::int32_t* row = &stored.nodes[k * kNodeWidth];
    node.begin = row[0];
    node.end = row[1];
    node.left = row[2];
    node.right = row[3];
    const std::uint8_t* counts = &stored.functions[k * kFunctionWidth];
    std::copy(counts, counts + node.counts.size(), node.counts.begin());
    node.used = counts[node.counts.size()];
    check_functions(node, k);
  }
  check_tree(basis.nodes, n_rows);
  require_length(stored.numbers.size(), place_numbers(basis), "numbers of its functions");
  basis.numbers = std::move(stored.numbers);
  return basis;
}

void check_ends(const std::vector<Node>& nodes, std::int32_t a, std::int32_t b,
                const std::string& what, std::size_t number) {
  const auto n = static_cast<std::int32_t>(nodes.size());
  if (a < 0 || a >= n || b < 0 || b >= n)
    refuse(what, number, "is between nodes that are not there");
}

void check_error(float error, const std::string& what, std::size_t number) {
  if (!(error >= 0 && std::isfinite(error))) refuse(what, number, "has a standard error below 0");
}

void restore_far(const StoredBlocks& stored, CompressedBlocks& blocks) {
  const std::vector<Node>& nodes = blocks.basis.nodes;
  const std::size_t n = stored.far_errors.size();
  require_length(stored.far.size(), 2 * n, "ends of far blocks");
  require_length(stored.degrees.size(), 2 * n, "degrees of far blocks");
  blocks.far.resize(n);
  std::uint64_t size = 0;
  for (std::size_t k = 0; k < n; ++k) {
    CompressedBlocks::Far& far = blocks.far[k];
    far.a = stored.far[2 * k];
    far.b = stored.far[2 * k + 1];
    far.error = stored.far_errors[k];
    far.first = size;
    check_ends(nodes, far.a, far.b, "far block", k);
    check_error(far.error, "far block", k);
    const std::uint8_t degree_a = stored.degrees[2 * k];
    const std::uint8_t degree_b = stored.degrees[2 * k + 1];
    if (degree_a > NestedBasis::kMostDegree || degree_b > NestedBasis::kMostDegree ||
        nodes[far.a].counts[degree_a] > nodes[far.a].used ||
        nodes[far.b].counts[degree_b] > nodes[far.b].used) {
      refuse("far block", k, "has functions that its nodes have not");
    }
    far.degrees = {static_cast<std::int8_t>(degree_a), static_cast<std::int8_t>(degree_b)};
    size += n_far_coefficients(nodes, far);
  }
  require_length(stored.coefficients.size(), size, "coefficients");
}

void restore_near(const StoredBlocks& stored, CompressedBlocks& blocks) {
  const std::vector<Node>& nodes = blocks.basis.nodes;
  const std::size_t n = stored.near_errors.size();
  require_length(stored.near.size(), 2 * n, "ends of near blocks");
  require_length(stored.near_change.size(), n, "marks of near blocks");
  blocks.near.resize(n);
  std::uint64_t size = 0;
  for (std::size_t k = 0; k < n; ++k) {
    CompressedBlocks::Near& near = blocks.near[k];
    near.a = stored.near[2 * k];
    near.b = stored.near[2 * k + 1];
    near.error = stored.near_errors[k];
    near.may_change = stored.near_change[k] != 0;
    near.first = size;
    check_ends(nodes, near.a, near.b, "near block", k);
    check_error(near.error, "near block", k);
    if (!nodes[near.a].is_leaf() || !nodes[near.b].is_leaf()) {
      refuse("near block", k, "is not between leaves");
    }
    size += n_densities(nodes[near.a], nodes[near.b]);
  }
  require_length(stored.densities.size(), size, "densities");
}

}  // namespace

StoredBlocks store(const CompressedBlocks& blocks) {
  StoredBlocks stored;
  stored.numbers = blocks.basis.numbers;
  for (const Node& node : blocks.basis.nodes) {
    stored.nodes.insert(stored.nodes.end(), {node.begin, node.end, node.left, node.right});
    stored.functions.insert(stored.functions.end(), node.counts.begin(), node.counts.end());
    stored.functions.push_back(node.used);
  }
  const std::vector<Node>& nodes = blocks.basis.nodes;
  for (const CompressedBlocks::Far& far : blocks.far) {
    stored.far.insert(stored.far.end(), {far.a, far.b});
    stored.degrees.push_back(static_cast<std::uint8_t>(far.degrees.a));
    stored.degrees.push_back(static_cast<std::uint8_t>(far.degrees.b));
    stored.far_errors.push_back(far.error);
    append(blocks.coefficients, far.first, n_far_coefficients(nodes, far), stored.coefficients);
  }
  for (const CompressedBlocks::Near& near : blocks.near) {
    stored.near.insert(stored.near.end(), {near.a, near.b});
    stored.near_change.push_back(near.may_change ? 1 : 0);
    stored.near_errors.push_back(near.error);
    append(blocks.densities, near.first, n_densities(nodes[near.a], nodes[near.b]),
           stored.densities);
  }
  return stored;
}

CompressedBlocks restore(StoredBlocks stored, Index n_rows) {
  CompressedBlocks blocks;
  blocks.basis = restore_basis(stored, n_rows);
  restore_far(stored, blocks);
  restore_near(stored, blocks);
  blocks.coefficients = std::move(stored.coefficients);
  blocks.densities = std::move(stored.densities);
  return blocks;
}

}  // namespace radiosity
