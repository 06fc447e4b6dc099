#include "radiosity/compressed/pair_sampler.h"

#include <cmath>

#include "radiosity/exchange/visible_fraction.h"

namespace radiosity {

PairSampler::PairSampler(const ClusterTree& tree, const ClusterShapes& shapes,
                         const std::vector<double>& areas)
    : tree_(tree), shapes_(shapes), areas_(areas) {}

std::size_t PairSampler::n_pairs(std::int32_t a, std::int32_t b) const {
  const Cluster& ca = tree_.clusters[a];
  const Cluster& cb = tree_.clusters[b];
  return static_cast<std::size_t>((ca.end - ca.begin) * (cb.end - cb.begin));
}

bool PairSampler::add(std::int32_t a, std::int32_t b, std::size_t n, const Density& density,
                      std::vector<DensitySample>& samples) const {
  const auto& order = tree_.order;
  const auto take = [&](std::int32_t row, std::int32_t column, double weight) {
    samples.push_back({row, column, density(order[row], order[column]), weight});
  };
  if (const std::size_t all = n_pairs(a, b); all <= 2 * n) {
    if (samples.size() == all && samples[0].weight != 1) return true;
    samples.clear();
    const Cluster& ca = tree_.clusters[a];
    const Cluster& cb = tree_.clusters[b];
    for (Index r = ca.begin; r < ca.end; ++r) {
      for (Index c = cb.begin; c < cb.end; ++c) {
        take(static_cast<std::int32_t>(r), static_cast<std::int32_t>(c),
             areas_[order[r]] * areas_[order[c]]);
      }
    }
    return true;
  }
  // Evenly spread in both. (Roberts 2018, the R2 sequence)
  constexpr double kFirst = 0.7548776662466927;
  constexpr double kSecond = 0.5698402909980532;
  const std::uint64_t seed = pair_seed(1, a, b);
  const double shift_a = static_cast<double>(seed & 0xffffffU) / 0x1000000;
  const double shift_b = static_cast<double>(seed >> 32U & 0xffffffU) / 0x1000000;
  while (samples.size() < n) {
    const auto k = static_cast<double>(samples.size());
    double whole = 0;
    const std::int32_t row = shapes_.place_at(a, std::modf(shift_a + k * kFirst, &whole));
    const std::int32_t column = shapes_.place_at(b, std::modf(shift_b + k * kSecond, &whole));
    take(row, column, 1);
  }
  return false;
}

void PairSampler::add_corners(std::int32_t a, std::int32_t b, const Density& density,
                              std::vector<DensitySample>& samples) const {
  const auto& order = tree_.order;
  const ClusterShapes::Extremes& of_a = shapes_.extremes(a);
  const ClusterShapes::Extremes& of_b = shapes_.extremes(b);
  for (int r = 0; r < of_a.n; ++r) {
    for (int c = 0; c < of_b.n; ++c) {
      const std::int32_t row = of_a.places[r];
      const std::int32_t column = of_b.places[c];
      samples.push_back({row, column, density(order[row], order[column]), 1});
    }
  }
}

}  // namespace radiosity
