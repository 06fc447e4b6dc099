#pragma once

#include <cstdint>
#include <span>

#include "radiosity/exchange/exchange_evaluator.h"

namespace radiosity {

/// Makes something of each block of the exchange matrix.
class BlockVisitor {
 public:
  virtual ~BlockVisitor() = default;
  /// Whether a cluster is taken as a whole. The leaves must be, or something above each.
  [[nodiscard]] virtual bool is_whole(std::int32_t cluster) const = 0;
  /// Whether anything between two clusters is wanted.
  [[nodiscard]] virtual bool wants(std::int32_t a, std::int32_t b) const = 0;
  /// Takes the block between two clusters that are whole, and those between the first and all
  /// images of the second: what is known for each part of the tree. Called from many threads at
  /// once.
  virtual void visit(std::int32_t a, std::int32_t b, std::span<const Between> between) = 0;
};

/// Descends from the first part's root and itself to blocks between whole clusters, each pair once,
/// in parallel; what is known of blocks is narrowed on the way.
void walk_blocks(const ExchangeEvaluator& evaluator, BlockVisitor& visitor);

}  // namespace radiosity
