#include "radiosity/compressed/block_maker.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <utility>

#include "radiosity/base/parallel.h"
#include "radiosity/compressed/shared_parts.h"
#include "radiosity/visibility/cluster_visibility.h"

namespace radiosity {
namespace {

/// Clusters are distant from so many diameters between them on.
constexpr double kDistant = 0.5;
/// Degrees tried at most where all is visible, and elsewhere.
constexpr int kVisibleDegree = 3;
constexpr int kSampledDegree = 2;
/// Items are worked on level by level until there are so many.
constexpr std::size_t kItems = 4096;
/// Each degree more may make the error so many times smaller.
constexpr double kGain = 6;
constexpr double kSampledGain = 3;
/// A degree more is worth its coefficients if the error falls to such a share.
constexpr double kLeastGain = 0.85;
/// Few samples may agree by chance: how much larger errors are then taken to be, over the root of
/// the number of samples.
constexpr double kDoubt = 1.5;
/// Samples beyond those that the coefficients take.
constexpr int kSpareSamples = 5;
/// What samples that agree may have missed: so many times the largest open density over the root
/// of their number.
constexpr double kUnseen = 0.5;

std::size_t visible_samples(int n_coefficients) {
  return static_cast<std::size_t>(1.5 * n_coefficients) + 10;
}

std::size_t sampled_samples(int n_coefficients) {
  return static_cast<std::size_t>(3 * n_coefficients) + kSpareSamples;
}

}  // namespace

BlockMaker::BlockMaker(const ExchangeEvaluator& evaluator, const ClusterPolynomials& polynomials,
                       const std::vector<double>& areas, const Progress& progress, Ranks* ranks)
    : evaluator_(evaluator),
      polynomials_(polynomials),
      areas_(areas),
      progress_(progress),
      ranks_(ranks),
      shapes_(evaluator, areas),
      sampler_(evaluator.tree(), shapes_, areas) {}

double BlockMaker::action_error(std::int32_t a, std::int32_t b, double density_error) const {
  const double area_a = polynomials_.area(a);
  const double area_b = polynomials_.area(b);
  return density_error * std::sqrt(area_a * area_b * (area_a + area_b) / shapes_.total_area());
}

void BlockMaker::accept(const Item& item, DegreePair degrees, const BlockFit& fit, double error,
                        MadeBlocks& made) const {
  made.far.push_back(
      {item.a, item.b, degrees, static_cast<float>(error), made.coefficients.size()});
  for (const double c : fit.coefficients) made.coefficients.push_back(static_cast<float>(c));
}

bool BlockMaker::fit_visible(const Item& item, double limit, BlockFitter& fitter,
                             MadeBlocks& made) const {
  const auto n_pairs = static_cast<double>(sampler_.n_pairs(item.a, item.b));
  const int most = std::min(
      {kVisibleDegree, polynomials_.most_degree(item.a), polynomials_.most_degree(item.b)});
  fitter.start(item.a, item.b, most);
  const PairSampler::Density density = [&](std::int32_t i, std::int32_t j) {
    return evaluator_.unoccluded(i, j) / (areas_[i] * areas_[j]);
  };
  std::vector<DensitySample> samples;
  sampler_.add_corners(item.a, item.b, density, samples);
  const std::size_t n_corners = samples.size();
  int before = 0;
  for (int degree = 0; degree <= most; ++degree) {
    const DegreePair degrees{static_cast<std::int8_t>(degree), static_cast<std::int8_t>(degree)};
    const int n = n_coefficients(polynomials_.counts(item.a), polynomials_.counts(item.b), degrees);
    if (degree > 0 && (n == before || 2 * n > n_pairs)) return false;
    before = n;
    const bool are_all =
        sampler_.add(item.a, item.b, n_corners + visible_samples(n), density, samples);
    const BlockFit fit = fitter.fit(degrees, samples, are_all);
    const double error = action_error(item.a, item.b, fit.error);
    if (error <= limit && fit.lowest >= 0) {
      accept(item, degrees, fit, fit.error, made);
      return true;
    }
    if (error > limit * std::pow(kGain, most - degree)) return false;
  }
  return false;
}

/// What an item's samples may have missed: that they agree proves nothing about the pairs between
/// them, of which all may be open.
double BlockMaker::unseen(const Item& item) const {
  const auto& order = evaluator_.tree().order;
  double largest = 0;
  for (const DensitySample& sample : item.samples) {
    largest = std::max(largest, shapes_.open_density(order[sample.row], order[sample.column]));
  }
  if (largest == 0) largest = shapes_.largest_density(item.a, item.b);
  return kUnseen * largest / std::sqrt(static_cast<double>(item.samples.size() + 2));
}

bool BlockMaker::fit_sampled(Item& item, double limit, Worker& worker, MadeBlocks& made) const {
  const auto n_pairs = static_cast<double>(sampler_.n_pairs(item.a, item.b));
  const int most = std::min(
      {kSampledDegree, polynomials_.most_degree(item.a), polynomials_.most_degree(item.b)});
  worker.fitter.start(item.a, item.b, most);
  const PairSampler::Density density = [&](std::int32_t i, std::int32_t j) {
    ++made.census.samples;
    return evaluator_.entry(i, j, item.between, worker.exchange).value / (areas_[i] * areas_[j]);
  };
  struct Trial {
    DegreePair degrees{};
    int n = 0;
    BlockFit fit{};
    double off = 0;
  };
  const auto count = [&](DegreePair degrees) {
    return n_coefficients(polynomials_.counts(item.a), polynomials_.counts(item.b), degrees);
  };
  const auto attempt = [&](DegreePair degrees) {
    Trial trial{.degrees = degrees, .n = count(degrees)};
    const bool are_all =
        sampler_.add(item.a, item.b, sampled_samples(trial.n), density, item.samples);
    trial.fit = worker.fitter.fit(degrees, item.samples, are_all);
    trial.off = trial.fit.error;
    if (are_all) return trial;
    const auto n_samples = static_cast<double>(item.samples.size());
    trial.off *= 1 + kDoubt / std::sqrt(n_samples - trial.n);
    trial.off = std::max(trial.off, unseen(item));
    return trial;
  };
  Trial best = attempt({});
  while (true) {
    const double error = action_error(item.a, item.b, best.off);
    if (error <= limit && best.fit.lowest >= 0) {
      accept(item, best.degrees, best.fit, best.off, made);
      return true;
    }
    const int left = 2 * most - best.degrees.a - best.degrees.b;
    if (left == 0 || error > limit * std::pow(kSampledGain, left)) return false;
    Trial next;
    for (const bool in_a : {true, false}) {
      DegreePair degrees = best.degrees;
      ++(in_a ? degrees.a : degrees.b);
      const int n = count(degrees);
      if (std::max(degrees.a, degrees.b) > most || n == best.n || 2 * n > n_pairs) continue;
      Trial trial = attempt(degrees);
      if (next.n == 0 || trial.off < next.off) {
        next = std::move(trial);
        item.varies_more_in_a = in_a;
      }
    }
    if (next.n == 0 || next.off > kLeastGain * best.off) return false;
    best = std::move(next);
  }
}

void BlockMaker::evaluate_near(const Item& item, ExchangeEvaluator::Worker& worker,
                               MadeBlocks& made) const {
  const Cluster& ca = evaluator_.tree().clusters[item.a];
  const Cluster& cb = evaluator_.tree().clusters[item.b];
  const Index n_rows = ca.end - ca.begin;
  const Index n_columns = cb.end - cb.begin;
  const std::uint64_t first = made.densities.size();
  bool any = false;
  double variance = 0;  // of F 1, over the block, times areas
  const auto set = [&](Index r, Index c, const ExchangeArea& entry) {
    const std::int32_t i = evaluator_.tree().order[ca.begin + r];
    const std::int32_t j = evaluator_.tree().order[cb.begin + c];
    if (!any) made.densities.resize(first + n_rows * n_columns);
    any = true;
    made.densities[first + r * n_columns + c] =
        static_cast<float>(entry.value / (areas_[i] * areas_[j]));
    variance += square(entry.error) * (1 / areas_[i] + 1 / areas_[j]);
    ++made.census.near_entries;
  };
  evaluator_.visit_block(item.a, item.b, item.between, worker,
                         [&](Index row, Index column, const ExchangeArea& entry) {
                           set(row - ca.begin, column - cb.begin, entry);
                           if (item.a == item.b) set(column - cb.begin, row - ca.begin, entry);
                         });
  if (!any) return;
  const double area_a = polynomials_.area(item.a);
  const double area_b = polynomials_.area(item.b);
  const double error = std::sqrt(variance / (area_a * area_b * (area_a + area_b)));
  const bool may_change = evaluator_.is_uniform(item.a) && evaluator_.is_uniform(item.b);
  made.near.push_back({item.a, item.b, static_cast<float>(error), may_change, first});
}

void BlockMaker::divide(const Item& item, Items& open) const {
  const auto& clusters = evaluator_.tree().clusters;
  const Cluster& ca = clusters[item.a];
  const Cluster& cb = clusters[item.b];
  const auto add = [&](std::int32_t a, std::int32_t b) {
    Item child{a, b};
    if (are_averted(clusters[a], clusters[b], evaluator_.prepared().thickness)) return;
    child.between = evaluator_.narrowed(a, b, item.between);
    if (child.between.is_hidden) return;
    const auto holds = [&](std::int32_t cluster, std::int32_t place) {
      return place >= clusters[cluster].begin && place < clusters[cluster].end;
    };
    for (const DensitySample& sample : item.samples) {
      if (sample.weight == 1 && holds(a, sample.row) && holds(b, sample.column)) {
        child.samples.push_back(sample);
      }
    }
    open.push_back(std::move(child));
  };
  if (item.a == item.b) {
    add(ca.left, ca.left);
    add(ca.left, ca.right);
    add(ca.right, ca.right);
  } else if (cb.is_leaf() ||
             (!ca.is_leaf() && item.varies_more_in_a.value_or(shapes_.diameter(item.a) >=
                                                              shapes_.diameter(item.b)))) {
    add(ca.left, item.b);
    add(ca.right, item.b);
  } else {
    add(item.a, cb.left);
    add(item.a, cb.right);
  }
}

/// Makes a block of an item, or items of its parts.
void BlockMaker::work(Item item, double limit, Worker& worker, MadeBlocks& made,
                      Items& open) const {
  const auto& clusters = evaluator_.tree().clusters;
  const bool is_distant =
      item.a != item.b &&
      shapes_.gap(item.a, item.b) >=
          kDistant * std::max(shapes_.diameter(item.a), shapes_.diameter(item.b)) &&
      evaluator_.is_uniform(item.a) && evaluator_.is_uniform(item.b);
  if (is_distant) {
    const bool is_visible = item.between.candidates.empty() && shapes_.is_facing(item.a, item.b) &&
                            shapes_.is_facing(item.b, item.a);
    if (is_visible ? fit_visible(item, limit, worker.fitter, made)
                   : fit_sampled(item, limit, worker, made)) {
      return;
    }
  }
  if (clusters[item.a].is_leaf() && clusters[item.b].is_leaf()) {
    evaluate_near(item, worker.exchange, made);
  } else {
    divide(item, open);
  }
}

/// All blocks of an item and its parts.
MadeBlocks BlockMaker::make_item(Item item, double limit) const {
  Worker worker{evaluator_.worker(), {polynomials_, evaluator_.tree().order}};
  MadeBlocks made;
  Items open;
  open.push_back(std::move(item));
  while (!open.empty()) {
    progress_.check();
    Item next = std::move(open.back());
    open.pop_back();
    work(std::move(next), limit, worker, made, open);
  }
  made.pairs += worker.exchange.census;
  return made;
}

void BlockMaker::spread(Items& items, double limit, MadeBlocks& result) const {
  while (!items.empty() && items.size() < kItems) {
    std::vector<Items> open(items.size());
    std::vector<MadeBlocks> made(items.size());
    parallel_for(static_cast<std::ptrdiff_t>(items.size()), [&](std::ptrdiff_t k) {
      progress_.check();
      Worker worker{evaluator_.worker(), {polynomials_, evaluator_.tree().order}};
      work(std::move(items[k]), limit, worker, made[k], open[k]);
      made[k].pairs += worker.exchange.census;
    });
    items.clear();
    for (std::size_t k = 0; k < open.size(); ++k) {
      result.append(std::move(made[k]));
      std::move(open[k].begin(), open[k].end(), std::back_inserter(items));
    }
  }
}

MadeBlocks BlockMaker::make(Items items, double limit, BlockStore* store) const {
  MadeBlocks result;
  spread(items, limit, result);
  if (store != nullptr) store->start_round(items.size(), limit);
  if (ranks_ != nullptr) {
    const auto make_part = [&](std::size_t k) { return make_item(std::move(items[k]), limit); };
    for (MadeBlocks& blocks :
         make_shared_parts(*ranks_, items.size(), store, make_part, progress_)) {
      result.append(std::move(blocks));
    }
    return result;
  }
  std::vector<MadeBlocks> made(items.size());
  std::mutex mutex;
  double n_done = 0;
  parallel_for(static_cast<std::ptrdiff_t>(items.size()), [&](std::ptrdiff_t k) {
    std::optional<MadeBlocks> known;
    if (store != nullptr) known = store->part(k);
    if (known) {
      made[k] = std::move(*known);
    } else {
      made[k] = make_item(std::move(items[k]), limit);
      if (store != nullptr) store->put(k, made[k]);
    }
    if (!progress_.report) return;
    const std::lock_guard lock(mutex);
    progress_.report("form factors", ++n_done, static_cast<double>(made.size()), "parts");
  });
  for (MadeBlocks& blocks : made) result.append(std::move(blocks));
  return result;
}

MadeBlocks BlockMaker::make(double limit, BlockStore* store) const {
  Items items;
  if (evaluator_.size() > 0) items.push_back({0, 0, evaluator_.everything()});
  return make(std::move(items), limit, store);
}

void BlockMaker::make_part(double limit, BlockStore& store, WorkPart part) const {
  Items items;
  if (evaluator_.size() > 0) items.push_back({0, 0, evaluator_.everything()});
  MadeBlocks of_all_parts;
  spread(items, limit, of_all_parts);
  store.start_round(items.size(), limit);
  Items own;
  std::vector<std::size_t> numbers;
  for (std::size_t k = part.number; k < items.size(); k += part.n_parts) {
    own.push_back(std::move(items[k]));
    numbers.push_back(k);
  }
  std::mutex mutex;
  double n_done = 0;
  parallel_for(static_cast<std::ptrdiff_t>(own.size()), [&](std::ptrdiff_t k) {
    if (!store.part(numbers[k])) store.put(numbers[k], make_item(std::move(own[k]), limit));
    if (!progress_.report) return;
    const std::lock_guard lock(mutex);
    progress_.report("form factors", ++n_done, static_cast<double>(own.size()), "parts");
  });
}

MadeBlocks BlockMaker::refine(MadeBlocks blocks, double limit, BlockStore* store) const {
  MadeBlocks result;
  Items items;
  for (const CompressedBlocks::Far& block : blocks.far) {
    if (action_error(block.a, block.b, block.error) > limit) {
      items.push_back({block.a, block.b});
      continue;
    }
    const std::uint64_t first = result.coefficients.size();
    const int n =
        n_coefficients(polynomials_.counts(block.a), polynomials_.counts(block.b), block.degrees);
    result.coefficients.insert(result.coefficients.end(), blocks.coefficients.begin() + block.first,
                               blocks.coefficients.begin() + block.first + n);
    result.far.push_back(block);
    result.far.back().first = first;
  }
  result.near = std::move(blocks.near);
  result.densities = std::move(blocks.densities);
  result.census = blocks.census;
  result.pairs = blocks.pairs;
  parallel_for(static_cast<std::ptrdiff_t>(items.size()), [&](std::ptrdiff_t k) {
    items[k].between = evaluator_.narrowed(items[k].a, items[k].b, evaluator_.everything());
  });
  result.append(make(std::move(items), limit, store));
  return result;
}

}  // namespace radiosity
