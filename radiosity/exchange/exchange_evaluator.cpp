#include "radiosity/exchange/exchange_evaluator.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "radiosity/base/parallel.h"
#include "radiosity/polygon/exchange_area.h"
#include "radiosity/visibility/regions.h"
#include "radiosity/visibility/shaft.h"

namespace radiosity {
namespace {

/// Relative error of the unoccluded kernel, a matter of nanoseconds next to visibility.
constexpr double kKernelTolerance = 1e-7;
/// Share of the tolerance that it may use up.
constexpr double kKernelShare = 1e-4;
/// Up to this many patches it is exact: time is no matter there.
constexpr Index kExactPatches = 512;
constexpr double kExactTolerance = 1e-11;
/// Pairs that are tried, from so many patches on, so many for each and at most, to find what errors
/// they may have; what the sum of standard errors then aims at, in tolerances: the sum of true
/// errors is some 0.8 of it; and by how much a pair's may change.
constexpr std::int32_t kFewestTried = 256;
constexpr Index kTriedOfPatch = 3;
constexpr Index kMostTried = 8192;
constexpr std::uint64_t kTrialSeed = 0x7a11;
constexpr std::uint64_t kCheckingSeed = 0xc4ec;
constexpr double kAim = 0.95;
constexpr double kLeastBudget = 0.3;
constexpr double kMostBudget = 3;
constexpr double kClutter = 0.15;

/// Exchange area of a pair on average, where every patch sees half of the others, m².
double mean_exchange_area(const PatchMesh& mesh) {
  const double area = std::accumulate(mesh.area.begin(), mesh.area.end(), 0.0);
  const auto n = static_cast<double>(std::max<Index>(mesh.size(), 1));
  return 2 * area / (n * n);
}

double kernel_tolerance(Index n_patches, double tolerance) {
  if (n_patches <= kExactPatches) return kExactTolerance;
  return std::max(std::min(kKernelTolerance, kKernelShare * tolerance), kExactTolerance);
}

ExchangeArea counted(const PairEstimate& estimate, Census& census) {
  census.visible += estimate.blocking == Blocking::none ? 1 : 0;
  census.hidden += estimate.blocking == Blocking::all ? 1 : 0;
  census.undecided += estimate.blocking == Blocking::some ? 1 : 0;
  census.partial += estimate.is_partial ? 1 : 0;
  census.rays += estimate.rays;
  return {estimate.value, estimate.error, estimate.blocking != Blocking::some};
}

}  // namespace

ExchangeEvaluator::ExchangeEvaluator(const PatchMesh& mesh, const Visibility& visibility,
                                     const Coverage& coverage, const EvaluatorOptions& options)
    : visibility_(visibility),
      coverage_(coverage),
      options_(options),
      prepared_(mesh, options.n_parts),
      kernel_(prepared_, kernel_tolerance(mesh.size(), options.tolerance)),
      pair_options_{.tolerance = options.tolerance,
                    .mean_area = mean_exchange_area(mesh),
                    .thickness = prepared_.thickness,
                    .kernel_tolerance = kernel_.tolerance()},
      region_(find_regions(mesh, visibility, prepared_.thickness)) {
  find_regions_of_clusters();
  find_known_clusters();
  find_budget();
}

ExchangeEvaluator::Worker ExchangeEvaluator::checking_worker(double share) const {
  OccludedPairOptions options = pair_options_;
  options.tolerance *= share;
  return {OccludedPairEstimator(visibility_, options), options_.seed ^ kCheckingSeed};
}

/// The region that all patches of a cluster look into, -1 if there are several.
void ExchangeEvaluator::find_regions_of_clusters() {
  for (const Cluster& cluster : tree().clusters) {
    std::int32_t region = region_[tree().order[cluster.begin]];
    for (Index k = cluster.begin + 1; k < cluster.end && region >= 0; ++k) {
      if (region_[tree().order[k]] != region) region = -1;
    }
    region_of_cluster_.push_back(region);
    has_covered_.push_back(
        std::any_of(tree().order.begin() + cluster.begin, tree().order.begin() + cluster.end,
                    [this](std::int32_t patch) { return coverage_.share[patch] > 0; }));
  }
}

bool ExchangeEvaluator::are_apart(std::int32_t a, std::int32_t b) const {
  return region_of_cluster_[a] >= 0 && region_of_cluster_[b] >= 0 &&
         region_of_cluster_[a] != region_of_cluster_[b];
}

void ExchangeEvaluator::find_known_clusters() {
  is_known_.assign(tree().clusters.size(), false);
  if (options_.known.transport == nullptr) return;
  const auto order = tree().order.begin();
  for (std::size_t k = 0; k < tree().clusters.size(); ++k) {
    const Cluster& cluster = tree().clusters[k];
    is_known_[k] =
        std::all_of(order + cluster.begin, order + cluster.end,
                    [this](std::int32_t patch) { return options_.known.patch[patch] >= 0; });
  }
}

/// The standard error of a pair as it would be computed, m².
double ExchangeEvaluator::trial_error(std::int32_t i, std::int32_t j) const {
  if (i == j || coverage_.is_covered(i) || coverage_.is_covered(j)) return 0;
  if (region_[i] != region_[j]) return 0;
  const Blocking front_i = kernel_.in_front(i, j);
  const Blocking front_j = kernel_.in_front(j, i);
  if (front_i == Blocking::none || front_j == Blocking::none) return 0;
  const Between found = between(i, j);
  if (found.is_hidden || found.candidates.empty()) return 0;
  Worker trial = worker();
  return occluded_entry(i, j, front_i, front_j, found.candidates, trial).error;
}

/// Tries some pairs, to see by how much the errors of all together would miss what is asked: few
/// are partly hidden in one scene, many in another.
void ExchangeEvaluator::find_budget() {
  const auto n = static_cast<std::int32_t>(size());
  if (n < kFewestTried) return;
  const Index n_tried = std::min<Index>(kTriedOfPatch * n, kMostTried);
  std::vector<double> errors(n_tried);
  parallel_for(n_tried, [&](std::ptrdiff_t k) {
    const auto place = static_cast<std::int32_t>(k);
    const auto pick = [&](std::int32_t which) {
      return static_cast<std::int32_t>(pair_seed(kTrialSeed, place, which) %
                                       static_cast<std::uint64_t>(n));
    };
    const std::int32_t a = pick(0);
    const std::int32_t b = pick(1);
    errors[k] = trial_error(std::min(a, b), std::max(a, b));
  });
  double sum = 0;
  for (const double error : errors) sum += error;
  const double mean = sum / static_cast<double>(n_tried);
  // Of all pairs, seen or not, the mean exchange area is half of that.
  const double asked = kAim * options_.tolerance * 0.5 * pair_options_.mean_area;
  // Where little is partly hidden it costs little, and errors stay as small as they come.
  if (mean < kClutter * asked) return;
  pair_options_.budget *= std::clamp(asked / mean, kLeastBudget, kMostBudget);
}

Between ExchangeEvaluator::filtered(const Cluster& a, const Cluster& b,
                                    const Candidates& candidates) const {
  auto kept = possible_blockers(a, b, prepared_.blockers, candidates, prepared_.thickness);
  if (!kept) return {{}, true};
  return {std::move(*kept), false};
}

Between ExchangeEvaluator::between(std::int32_t i, std::int32_t j) const {
  return filtered(alone(i), alone(j), all_candidates(prepared_.blockers));
}

Between ExchangeEvaluator::narrowed(std::int32_t a, std::int32_t b, const Between& wider) const {
  if (wider.is_hidden || are_apart(a, b)) return {{}, true};
  if (is_known_[a] && is_known_[b]) return {};
  return filtered(tree().clusters[a], tree().clusters[b], wider.candidates);
}

void ExchangeEvaluator::visit_block(std::int32_t a, std::int32_t b, const Between& between,
                                    Worker& worker, const Visit& visit) const {
  const Cluster& ca = tree().clusters[a];
  const Cluster& cb = tree().clusters[b];
  if (are_averted(ca, cb, prepared_.thickness)) return;
  const bool is_diagonal = are_images(ca, cb);
  const Index first = a == b ? 1 : cb.begin - ca.begin;  // beyond a row, on the diagonal or above
  if (ca.is_leaf() && cb.is_leaf()) {
    for (Index r = ca.begin; r < ca.end; ++r) {
      for (Index c = is_diagonal ? r + first : cb.begin; c < cb.end; ++c) {
        const ExchangeArea found = entry(tree().order[r], tree().order[c], between, worker);
        if (found.value != 0 || !found.is_certain) visit(r, c, found);
      }
    }
    return;
  }
  const auto descend = [&](std::int32_t child_a, std::int32_t child_b) {
    visit_block(child_a, child_b, narrowed(child_a, child_b, between), worker, visit);
  };
  if (is_diagonal) {
    descend(ca.left, cb.left);
    descend(ca.left, cb.right);
    descend(ca.right, cb.right);
  } else if (cb.is_leaf() || (!ca.is_leaf() && ca.end - ca.begin >= cb.end - cb.begin)) {
    descend(ca.left, b);
    descend(ca.right, b);
  } else {
    descend(a, cb.left);
    descend(a, cb.right);
  }
}

void ExchangeEvaluator::visit_row(std::int32_t patch, Worker& worker,
                                  const VisitOfRow& visit) const {
  if (tree().clusters.empty()) return;
  visit_row(patch, alone(patch), 0, everything(), worker, visit);
}

void ExchangeEvaluator::visit_row(std::int32_t patch, const Cluster& own, std::int32_t b,
                                  const Between& wider, Worker& worker,
                                  const VisitOfRow& visit) const {
  const Cluster& cb = tree().clusters[b];
  if (are_averted(own, cb, prepared_.thickness)) return;
  if (region_of_cluster_[b] >= 0 && region_of_cluster_[b] != region_[patch]) return;
  const Between between = filtered(own, cb, wider.candidates);
  if (between.is_hidden) return;
  if (!cb.is_leaf()) {
    visit_row(patch, own, cb.left, between, worker, visit);
    visit_row(patch, own, cb.right, between, worker, visit);
    return;
  }
  for (Index c = cb.begin; c < cb.end; ++c) {
    const std::int32_t other = tree().order[c];
    if (other == patch) continue;
    const ExchangeArea found = entry(patch, other, between, worker);
    if (found.value != 0 || !found.is_certain) visit(c, found);
  }
}

ExchangeArea ExchangeEvaluator::entry(std::int32_t first, std::int32_t second,
                                      const Between& between, Worker& worker) const {
  // Whichever comes first, a pair is computed one way round.
  const std::int32_t i = std::min(first, second);
  const std::int32_t j = std::max(first, second);
  Census& census = worker.census;
  if (coverage_.is_covered(i) || coverage_.is_covered(j)) return {};
  const Blocking front_i = kernel_.in_front(i, j);
  if (front_i == Blocking::none) return {};
  const Blocking front_j = kernel_.in_front(j, i);
  if (front_j == Blocking::none) return {};
  ++census.facing;
  if (region_[i] != region_[j]) {
    ++census.hidden;
    return {};
  }
  if (const auto known = known_entry(i, j)) {
    ++census.known;
    return *known;
  }
  if (between.is_hidden) {
    ++census.hidden;
    return {};
  }
  if (coverage_.open.contains(i) || coverage_.open.contains(j)) {
    return entry_in_parts(i, j, between.candidates, worker);
  }
  if (!between.candidates.empty()) {
    return occluded_entry(i, j, front_i, front_j, between.candidates, worker);
  }
  ++census.visible;
  return {kernel_.unoccluded(i, j, front_i, front_j)};
}

/// The entry of two patches that an earlier operator had.
std::optional<ExchangeArea> ExchangeEvaluator::known_entry(std::int32_t i, std::int32_t j) const {
  if (options_.known.transport == nullptr) return std::nullopt;
  const std::int32_t earlier_i = options_.known.patch[i];
  const std::int32_t earlier_j = options_.known.patch[j];
  if (earlier_i < 0 || earlier_j < 0) return std::nullopt;
  return rows_of(*options_.known.transport).pair(earlier_i, earlier_j);
}

void ExchangeEvaluator::find_blockers(const Placed& a, const Placed& b,
                                      const Candidates& candidates, Worker& worker) const {
  const auto is_behind = [this](const Blocker& blocker, const HalfSpace& plane) {
    const double most = plane.offset + prepared_.thickness;
    return std::all_of(blocker.corners.begin(), blocker.corners.end(),
                       [&](const Vec3& corner) { return plane.normal.dot(corner) <= most; });
  };
  const auto add = [&](const Blocker& blocker) {
    if (is_behind(blocker, a.plane) || is_behind(blocker, b.plane)) return;
    worker.blockers.push_back(&blocker);
  };
  worker.blockers.clear();
  worker.groups.clear();
  for (const std::int32_t k : candidates) {
    if (prepared_.blockers.nodes[k].is_leaf()) {
      add(prepared_.blockers.blocker(k));
    } else {
      worker.groups.push_back(k);
    }
  }
  if (worker.groups.empty()) return;
  Box3 box_a;
  Box3 box_b;
  for (const Vec3& corner : a.polygon) box_a.extend(corner);
  for (const Vec3& corner : b.polygon) box_b.extend(corner);
  const BoxShaft shaft(box_a, box_b);
  while (!worker.groups.empty()) {
    const std::int32_t k = worker.groups.back();
    worker.groups.pop_back();
    const BlockerSet::Node& node = prepared_.blockers.nodes[k];
    if (shaft.misses(node.box, prepared_.thickness)) continue;
    if (!node.is_leaf()) {
      worker.groups.push_back(node.right);
      worker.groups.push_back(node.left);
      continue;
    }
    const Blocker& blocker = prepared_.blockers.blocker(k);
    if (!shaft.misses(blocker.box, blocker.corners, prepared_.thickness)) add(blocker);
  }
}

/// An entry that some candidate may block.
ExchangeArea ExchangeEvaluator::occluded_entry(std::int32_t i, std::int32_t j, Blocking front_i,
                                               Blocking front_j, const Candidates& candidates,
                                               Worker& worker) const {
  const auto part_in_front = [&](std::int32_t patch, std::int32_t of, Blocking front) {
    const ConvexPolygon& polygon = prepared_.polygons[patch];
    const HalfSpace& plane = prepared_.planes[of];
    return front == Blocking::all
               ? polygon
               : clip_to_half_space(polygon.points(), plane.normal * plane.offset, plane.normal,
                                    prepared_.thickness);
  };
  const ConvexPolygon polygon_i = part_in_front(i, j, front_j);
  const ConvexPolygon polygon_j = part_in_front(j, i, front_i);
  find_blockers(placed(i), placed(j), candidates, worker);
  if (worker.blockers.empty()) {
    ++worker.census.visible;
    return {kernel_.unoccluded(i, j, front_i, front_j)};
  }
  const PairEstimate estimate = worker.estimator.estimate(
      {polygon_i, prepared_.planes[i], polygon_j, prepared_.planes[j], i, j}, worker.blockers,
      [&] { return kernel_.unoccluded(i, j, front_i, front_j); }, pair_seed(worker.seed, i, j));
  return counted(estimate, worker.census);
}

/// The parts of patch i that nothing covers, in front of patch j.
std::vector<ConvexPolygon> ExchangeEvaluator::open_parts(std::int32_t i, std::int32_t j) const {
  const HalfSpace& plane = prepared_.planes[j];
  const auto parts = coverage_.open.find(i);
  const std::span<const ConvexPolygon> all = parts == coverage_.open.end()
                                                 ? std::span(&prepared_.polygons[i], 1)
                                                 : std::span(parts->second);
  std::vector<ConvexPolygon> result;
  for (const ConvexPolygon& part : all) {
    const ConvexPolygon seen = clip_to_half_space(part.points(), plane.normal * plane.offset,
                                                  plane.normal, prepared_.thickness);
    if (seen.size() >= 3) result.push_back(seen);
  }
  return result;
}

/// An entry of patches that solids cover in part.
ExchangeArea ExchangeEvaluator::entry_in_parts(std::int32_t i, std::int32_t j,
                                               const Candidates& candidates, Worker& worker) const {
  find_blockers(placed(i), placed(j), candidates, worker);
  PairEstimate sum;
  double variance = 0;
  bool all_visible = true;
  bool all_hidden = true;
  std::uint64_t seed = pair_seed(worker.seed, i, j);
  for (const ConvexPolygon& part_i : open_parts(i, j)) {
    for (const ConvexPolygon& part_j : open_parts(j, i)) {
      const auto unoccluded = [&] {
        return exchange_area(part_i.points(), part_j.points(), kernel_.tolerance());
      };
      const PairEstimate estimate = worker.estimator.estimate(
          {part_i, prepared_.planes[i], part_j, prepared_.planes[j], i, j}, worker.blockers,
          unoccluded, ++seed);
      sum.value += estimate.value;
      sum.rays += estimate.rays;
      sum.is_partial |= estimate.is_partial;
      variance += estimate.error * estimate.error;
      all_visible &= estimate.blocking == Blocking::none;
      all_hidden &= estimate.blocking == Blocking::all;
    }
  }
  sum.error = std::sqrt(variance);
  sum.blocking = all_hidden ? Blocking::all : all_visible ? Blocking::none : Blocking::some;
  return counted(sum, worker.census);
}

}  // namespace radiosity
