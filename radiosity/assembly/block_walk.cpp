#include "radiosity/assembly/block_walk.h"

#include <span>
#include <utility>
#include <vector>

#include "radiosity/base/parallel.h"

namespace radiosity {
namespace {

void walk(const ExchangeEvaluator& evaluator, BlockVisitor& visitor, std::int32_t a, std::int32_t b,
          std::span<const Between> wider) {
  if (!visitor.wants(a, b)) return;
  std::vector<Between> between;
  for (std::size_t g = 0; g < wider.size(); ++g) {
    between.push_back(evaluator.narrowed(a, evaluator.tree().image(b, g), wider[g]));
  }
  if (visitor.is_whole(a) && visitor.is_whole(b)) {
    visitor.visit(a, b, between);
    return;
  }
  const Cluster& ca = evaluator.tree().clusters[a];
  const Cluster& cb = evaluator.tree().clusters[b];
  std::vector<std::pair<std::int32_t, std::int32_t>> children;
  if (a == b) {
    children = {{ca.left, ca.left}, {ca.left, ca.right}, {ca.right, ca.right}};
  } else if (visitor.is_whole(b) ||
             (!visitor.is_whole(a) && ca.end - ca.begin >= cb.end - cb.begin)) {
    children = {{ca.left, b}, {ca.right, b}};
  } else {
    children = {{a, cb.left}, {a, cb.right}};
  }
  parallel_for(static_cast<std::ptrdiff_t>(children.size()), [&](std::ptrdiff_t k) {
    walk(evaluator, visitor, children[k].first, children[k].second, between);
  });
}

}  // namespace

void walk_blocks(const ExchangeEvaluator& evaluator, BlockVisitor& visitor) {
  if (evaluator.tree().clusters.empty()) return;
  const std::vector<std::int32_t>& roots = evaluator.tree().roots;
  const std::vector<Between> everything(roots.size(), evaluator.everything());
  walk(evaluator, visitor, roots[0], roots[0], everything);
}

}  // namespace radiosity
