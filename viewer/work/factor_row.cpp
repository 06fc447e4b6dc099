#include "viewer/work/factor_row.h"

#include <algorithm>
#include <numeric>

namespace viewer {
namespace {

using radiosity::Index;

constexpr std::size_t kMostPartners = 10;

}  // namespace

FactorRow make_factor_row(const radiosity::FactorRows& factors, const std::vector<double>& areas,
                          Index patch) {
  FactorRow result{.patch = patch, .factors = factors.row(patch), .sum = 0, .partners = {}};
  const Eigen::VectorXd& row = result.factors;
  result.sum = row.sum();
  std::vector<Index> order(static_cast<std::size_t>(row.size()));
  std::iota(order.begin(), order.end(), Index{0});
  const std::size_t n = std::min(kMostPartners, order.size());
  const auto middle = order.begin() + static_cast<std::ptrdiff_t>(n);
  std::partial_sort(order.begin(), middle, order.end(),
                    [&](Index a, Index b) { return row[a] != row[b] ? row[a] > row[b] : a < b; });
  for (std::size_t k = 0; k < n && row[order[k]] > 0; ++k) {
    // Errors of the whole row would take another product.
    const double error = factors.pair(patch, order[k]).error / areas[patch];
    result.partners.push_back({order[k], row[order[k]], error});
  }
  return result;
}

}  // namespace viewer
