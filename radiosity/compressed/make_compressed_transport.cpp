#include "radiosity/compressed/make_compressed_transport.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "radiosity/assembly/balance.h"
#include "radiosity/base/error.h"
#include "radiosity/base/machine_memory.h"
#include "radiosity/compressed/block_maker.h"
#include "radiosity/compressed/row_check.h"
#include "radiosity/exchange/openings.h"
#include "radiosity/exchange/pair_blockers.h"
#include "radiosity/exchange/polygon_exchange.h"
#include "radiosity/solve/solve.h"
#include "radiosity/visibility/coverage.h"

namespace radiosity {
namespace {

/// What a limit of the blocks' errors comes to in F 1 was measured on rooms and streets: some
/// kOfRoot times its root, for kFewPatches. As there are more blocks along edges, in the root of
/// the number of patches, and their squares add up, it grows by that number's fourth root. The
/// first limit is chosen so that it just may do.
constexpr double kOfRoot = 1.6;
constexpr double kFewPatches = 5000;
/// The next one aims at so much of what is asked, since errors go like its root; in steps, since a
/// single row far off makes an error look larger than it is.
constexpr double kAimedAt = 0.85;
constexpr double kLeastStep = 0.2;
constexpr double kMostStep = 0.6;
constexpr int kMostRounds = 6;
/// Rows that verify it, and as many again as long as they do not decide.
constexpr Index kRows = 64;
constexpr Index kMostRows = 256;
/// The verified error may be that much larger than what the blocks tell before it counts as told
/// wrong, and never less: errors are not made smaller by luck.
constexpr double kLeastScale = 1;
/// Tolerance of the light that the operator is verified with.
constexpr double kLightTolerance = 1e-2;
/// Rows off by more than so many of their errors, and the tolerance, are no errors but openings.
constexpr double kSigmas = 8;

/// Polygons at most that light is taken from exactly, and the error of each pair, in tolerances.
constexpr std::size_t kMostSources = 32;
constexpr double kSourceShare = 0.1;

/// Memory for the assembly of so many patches, bytes: measured on rooms at 1e-2, 1.3 KB for what is
/// prepared of a patch and up to 1.5 KB for its blocks.
constexpr double kBytesOfPatch = 2800;

/// What an operator shall act on rightly: 1, light that varies smoothly, and random signs.
Eigen::MatrixXd test_fields(const PatchMesh& mesh) {
  const Box3 box = bounds(mesh);
  const double scale = 1 / std::max(box.diagonal().norm(), std::numeric_limits<double>::min());
  Eigen::MatrixXd fields(mesh.size(), 3);
  for (Index i = 0; i < mesh.size(); ++i) {
    const Vec3 place = scale * (mesh.centroid[i] - box.min());
    fields(i, 0) = 1;
    fields(i, 1) = 1 + 0.5 * std::sin(7 * place.x() + 5 * place.y() - 3 * place.z());
    fields(i, 2) = (pair_seed(2, static_cast<std::int32_t>(i), 0) & 1U) != 0 ? 1 : -1;
  }
  return fields;
}

/// Rows of blocks of which each may change as a whole, the more the larger its error.
class AdjustableBlocks final : public AdjustableExchange {
 public:
  /// `areas` and `sums` (Σ_j G_ij, m²) in the tree's order.
  AdjustableBlocks(const CompressedMatrix& matrix, Eigen::VectorXd areas, Eigen::VectorXd sums)
      : matrix_(matrix),
        areas_(std::move(areas)),
        sums_(std::move(sums)),
        multipliers_(Eigen::VectorXd::Zero(areas_.size())) {}

  [[nodiscard]] Index size() const override { return areas_.size(); }
  [[nodiscard]] Eigen::VectorXd weighted_sums(const Eigen::VectorXd& x) const override {
    return areas_.cwiseProduct(matrix_.variance_product(areas_.cwiseProduct(x)).col(0));
  }
  void adjust(const Eigen::VectorXd& factors) override {
    multipliers_ += factors;
    sums_ +=
        factors.cwiseProduct(weighted_sums(Eigen::VectorXd::Ones(size()))) + weighted_sums(factors);
  }
  [[nodiscard]] Eigen::VectorXd row_sums() const override { return sums_; }
  [[nodiscard]] double rounding() const override { return kRounding; }
  [[nodiscard]] const Eigen::VectorXd& multipliers() const { return multipliers_; }

 private:
  static constexpr double kRounding = 1e-6;
  const CompressedMatrix& matrix_;
  Eigen::VectorXd areas_;
  Eigen::VectorXd sums_;
  Eigen::VectorXd multipliers_;
};

}  // namespace

/// Makes the operator round by round.
class CompressedAssembly {
 public:
  CompressedAssembly(const PatchMesh& mesh, const Visibility& visibility,
                     const TransportOptions& options, const ExpectedLight& light)
      : mesh_(mesh),
        visibility_(visibility),
        options_(options),
        light_(light),
        area_(Eigen::Map<const Eigen::VectorXd>(mesh.area.data(), mesh.size())),
        coverage_(find_coverage(mesh, plane_thickness(mesh))),
        evaluator_(mesh, visibility, coverage_,
                   {.tolerance = options.tolerance, .seed = options.seed}),
        polynomials_(mesh, evaluator_.tree()),
        maker_(evaluator_, polynomials_, mesh.area, options.progress) {}

  std::unique_ptr<CompressedTransport> make() {
    const auto start = std::chrono::steady_clock::now();
    find_sources();
    is_closed_ = options_.closed == Closed::yes ||
                 (options_.closed == Closed::automatic &&
                  is_enclosed(mesh_, visibility_, options_.tolerance, options_.seed));
    double limit = first_limit();
    made_ = maker_.make(limit);
    std::unique_ptr<CompressedTransport> transport = make_transport();
    RowCheck check = make_check(*transport);
    RowCheck::Error error = verify(check, *transport);
    int round = 0;
    while (error.limit > options_.tolerance && round < kMostRounds) {
      limit *=
          std::clamp(square(kAimedAt * options_.tolerance / error.limit), kLeastStep, kMostStep);
      transport.reset();
      made_ = maker_.refine(std::move(made_), limit);
      ++round;
      transport = make_transport();
      error = verify(check, *transport);
    }
    finish(*transport, error, round);
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    transport->parts_.report.seconds = elapsed.count();
    return transport;
  }

 private:
  [[nodiscard]] double first_limit() const {
    const double n = std::max(static_cast<double>(mesh_.size()) / kFewPatches, 1.0);
    return square(options_.tolerance / kOfRoot) / std::sqrt(n);
  }

  /// The operator of the blocks so far.
  std::unique_ptr<CompressedTransport> make_transport() {
    std::vector<std::int8_t> degrees(evaluator_.tree().clusters.size(), -1);
    double squares = 0;
    for (const CompressedBlocks::Far& block : made_.far) {
      degrees[block.a] = std::max(degrees[block.a], block.degrees.a);
      degrees[block.b] = std::max(degrees[block.b], block.degrees.b);
      squares += square(maker_.action_error(block.a, block.b, block.error));
    }
    for (const CompressedBlocks::Near& block : made_.near) {
      squares += square(maker_.action_error(block.a, block.b, block.error));
    }
    estimate_ = std::sqrt(squares);
    auto transport = std::make_unique<CompressedTransport>(
        CompressedTransport::Parts{.order = evaluator_.tree().order,
                                   .blocks = {polynomials_.make_basis(degrees), made_.far,
                                              made_.coefficients, made_.near, made_.densities},
                                   .area = area_});
    add_sources(*transport);
    close_rows(*transport);
    return transport;
  }

  /// The polygons that light comes from, where they are few, exactly.
  void find_sources() {
    if (light_.exitance.size() == 0 || mesh_.n_polygons() == 0) return;
    std::map<std::int32_t, std::vector<std::int32_t>> found;
    for (std::int32_t i = 0; i < static_cast<std::int32_t>(mesh_.size()); ++i) {
      if (!(light_.exitance.row(i).maxCoeff() > 0)) continue;
      // Two-sided polygons have patches of either side.
      const std::int32_t key =
          mesh_.twin[i] >= 0 && mesh_.twin[i] < i ? -1 - mesh_.polygon[i] : mesh_.polygon[i];
      found[key].push_back(i);
      if (found.size() > kMostSources) return;
    }
    for (auto& [key, patches] : found) {
      const auto polygon = source_polygon(patches);
      if (!polygon) continue;
      options_.progress.check();
      sources_.push_back({std::move(patches), {}});
      Source& source = sources_.back();
      source.exchange =
          polygon_exchange(evaluator_, *polygon, source.patches[0],
                           kSourceShare * options_.tolerance, options_.seed, options_.progress);
    }
  }

  /// The polygon that these patches divide, if it is convex, plane and uncovered.
  [[nodiscard]] std::optional<ConvexPolygon> source_polygon(
      const std::vector<std::int32_t>& patches) const {
    const auto outline = mesh_.outline(mesh_.polygon[patches[0]]);
    if (outline.size() > kMostCorners) return std::nullopt;
    const HalfSpace& plane = evaluator_.prepared().planes[patches[0]];
    ConvexPolygon polygon;
    for (const Vec3& corner : outline) polygon.push_back(corner - evaluator_.prepared().center);
    if (vector_area(polygon.points()).dot(plane.normal) < 0) {
      std::reverse(&polygon[0], &polygon[0] + polygon.size());
    }
    double area = 0;
    for (const std::int32_t patch : patches) {
      area += mesh_.area[patch];
      if (coverage_.share[patch] > 0 || evaluator_.region(patch) != evaluator_.region(patches[0])) {
        return std::nullopt;
      }
    }
    const double thickness = evaluator_.prepared().thickness;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      const Vec3& a = polygon[k];
      const Vec3& b = polygon[(k + 1) % polygon.size()];
      const Vec3& c = polygon[(k + 2) % polygon.size()];
      if (std::abs(plane.normal.dot(a) - plane.offset) > thickness) return std::nullopt;
      if ((b - a).cross(c - b).dot(plane.normal) < 0) return std::nullopt;
    }
    constexpr double kSameArea = 1e-6;
    if (std::abs(vector_area(polygon.points()).norm() - area) > kSameArea * area) {
      return std::nullopt;
    }
    return polygon;
  }

  void add_sources(CompressedTransport& transport) const {
    for (const Source& source : sources_) {
      Eigen::VectorXd indicator = Eigen::VectorXd::Zero(mesh_.size());
      for (const std::int32_t patch : source.patches) indicator[patch] = 1;
      const Eigen::VectorXd have = transport.apply(indicator).col(0).cwiseProduct(area_);
      transport.parts_.sources.push_back({source.patches, source.exchange - have});
    }
  }

  /// Notes row sums, and mends them if the scene is closed.
  void close_rows(CompressedTransport& transport) const {
    AssemblyReport& report = transport.parts_.report;
    static_cast<Census&>(report) = made_.pairs;
    report.closed = is_closed_;
    report.covered = coverage_.share;
    const Eigen::VectorXd ones = Eigen::VectorXd::Ones(transport.size());
    report.row_sums = transport.apply(ones);
    const Eigen::ArrayXd gap = 1 - coverage_.share.array() - report.row_sums.array();
    report.closure_mean = gap.abs().mean();
    report.closure_max = gap.abs().maxCoeff();
    if (!is_closed_) return;
    const PatchOrder& order = transport.order_;
    const Eigen::ArrayXd most =
        kSigmas * transport.apply_error(ones).col(0).array() + kSigmas * options_.tolerance;
    const Eigen::VectorXd mask = (gap.abs() <= most).cast<double>();
    RowSums sums{order.to_rows(area_.cwiseProduct(report.row_sums)).col(0),
                 order.to_rows(area_.array() * (1 - coverage_.share.array())).col(0),
                 order.to_rows(mask).col(0)};
    AdjustableBlocks exchange(transport.matrix_, order.to_rows(area_).col(0), sums.present);
    balance_rows(exchange, sums, 2);
    transport.parts_.multipliers = exchange.multipliers();
    report.open_rows = static_cast<std::int64_t>((mask.array() == 0).count());
  }

  [[nodiscard]] RowCheck make_check(const CompressedTransport& transport) const {
    Eigen::MatrixXd fields = test_fields(mesh_);
    if (light_.exitance.size() > 0 && light_.exitance.maxCoeff() > 0) {
      const Solution solution = solve(transport, light_.exitance, light_.reflectance,
                                      {.tolerance = kLightTolerance,
                                       .progress = {.report = {}, .stop = options_.progress.stop}});
      const Index n = fields.cols();
      fields.conservativeResize(Eigen::NoChange, n + solution.radiosity.cols());
      fields.rightCols(solution.radiosity.cols()) = solution.radiosity;
    }
    return {evaluator_, maker_.shapes(), mesh_.area, std::move(fields), options_.seed};
  }

  /// With as many rows as it takes to tell.
  [[nodiscard]] RowCheck::Error verify(RowCheck& check,
                                       const CompressedTransport& transport) const {
    const Eigen::MatrixXd gathered = transport.apply(check.radiosity());
    if (check.n_rows() == 0) check.add_rows(kRows, options_.progress);
    RowCheck::Error error = check.error(gathered);
    while (error.limit > options_.tolerance && error.estimate < kAimedAt * options_.tolerance &&
           check.n_rows() < kMostRows) {
      check.add_rows(check.n_rows(), options_.progress);
      error = check.error(gathered);
    }
    return error;
  }

  void finish(CompressedTransport& transport, const RowCheck::Error& error, int round) const {
    const auto n = static_cast<double>(mesh_.size());
    transport.parts_.report.compression = CompressionReport{
        .verified_error = error.limit,
        .estimated_error = estimate_,
        .n_rows = error.n_rows,
        .n_rounds = round,
        .coefficients = static_cast<double>(made_.coefficients.size() + made_.densities.size()) / n,
        .entries = static_cast<double>(made_.census.samples + made_.census.near_entries) / n};
    if (estimate_ > 0) {
      transport.parts_.error_scale = std::max(kLeastScale, error.limit / estimate_);
    }
    const Eigen::VectorXd present = transport.apply(Eigen::VectorXd::Ones(transport.size()));
    const Eigen::VectorXd missing = 1 - coverage_.share.array() - present.array();
    transport.parts_.report.backs = shares_on_backs(mesh_, visibility_, missing, options_.seed);
  }

  const PatchMesh& mesh_;
  const Visibility& visibility_;
  const TransportOptions& options_;
  const ExpectedLight& light_;
  Eigen::VectorXd area_;
  Coverage coverage_;
  ExchangeEvaluator evaluator_;
  ClusterPolynomials polynomials_;
  BlockMaker maker_;
  bool is_closed_ = false;
  /// A polygon that light comes from, and what it exchanges with each patch, m².
  struct Source {
    std::vector<std::int32_t> patches;
    Eigen::VectorXd exchange;
  };
  std::vector<Source> sources_;
  MadeBlocks made_;
  double estimate_ = 0;  // of the relative error of F 1
};

std::unique_ptr<CompressedTransport> make_compressed_transport(const PatchMesh& mesh,
                                                               const Visibility& visibility,
                                                               const TransportOptions& options,
                                                               const ExpectedLight& light) {
  check_compressed_memory(mesh.size(), options.memory);
  return CompressedAssembly(mesh, visibility, options, light).make();
}

void check_compressed_memory(Index n_patches, std::size_t memory) {
  const std::size_t limit = memory_limit(memory);
  const auto needed = static_cast<std::size_t>(kBytesOfPatch * static_cast<double>(n_patches));
  if (needed <= limit) return;
  const auto fits = static_cast<Index>(static_cast<double>(limit) / kBytesOfPatch);
  throw SolveError("the compressed form factors of " + std::to_string(n_patches) +
                   " patches need some " + gigabytes(needed) + " of memory, but " +
                   gigabytes(limit) + " can be used: use --patches " + std::to_string(fits) +
                   " or a scene of fewer polygons");
}

}  // namespace radiosity
