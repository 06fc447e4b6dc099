#include "radiosity/compressed/make_compressed_transport.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "radiosity/base/error.h"
#include "radiosity/base/machine_memory.h"
#include "radiosity/compressed/block_maker.h"
#include "radiosity/compressed/block_store.h"
#include "radiosity/compressed/closed_blocks.h"
#include "radiosity/compressed/light_polygons.h"
#include "radiosity/compressed/row_check.h"
#include "radiosity/exchange/openings.h"
#include "radiosity/exchange/visible_fraction.h"
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
/// The verified error may be that much larger than what the blocks tell before it counts as told
/// wrong, and never less: errors are not made smaller by luck.
constexpr double kLeastScale = 1;
/// Tolerance of the operator that is given to TransportOptions::rough, unless what is asked is not
/// much smaller.
constexpr double kRoughTolerance = 0.1;
constexpr double kMuchSmaller = 0.4;
/// Rows that verify it: fewer, since somebody waits. Of 16 one is told 19 % of 300,000 patches
/// where 64 tell 12 %.
constexpr Index kRoughRows = 32;
/// Tolerance of the light that the operator is verified with.
constexpr double kLightTolerance = 1e-2;

/// To be raised whenever the same scene and options give other numbers than before.
constexpr int kNumbersVersion = 3;

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
        progress_(options.progress),
        maker_(evaluator_, polynomials_, mesh.area, progress_, options.ranks) {}

  std::unique_ptr<CompressedTransport> make() {
    const auto start = std::chrono::steady_clock::now();
    const Eigen::MatrixXd& emitted = light_.emitted.size() > 0 ? light_.emitted : light_.exitance;
    lights_ = make_light_polygons(evaluator_, mesh_, emitting_polygons(mesh_, emitted), options_);
    is_closed_ = options_.closed == Closed::yes ||
                 (options_.closed == Closed::automatic &&
                  is_enclosed(mesh_, visibility_, options_.tolerance, options_.seed));
    if (options_.rough && options_.tolerance < kMuchSmaller * kRoughTolerance) give_rough();
    open_store();
    BlockStore* store = store_ ? &*store_ : nullptr;
    double limit = first_limit(options_.tolerance);
    made_ = maker_.make(limit, store);
    std::unique_ptr<CompressedTransport> transport = make_transport(options_.tolerance);
    RowCheck check = make_check(*transport);
    RowCheck::Error error = verify(check, *transport);
    int round = 0;
    while (error.limit > options_.tolerance && round < kMostRounds) {
      limit *=
          std::clamp(square(kAimedAt * options_.tolerance / error.limit), kLeastStep, kMostStep);
      if (options_.rough) {
        tell(*transport, error, round);
        options_.rough(std::move(transport));
      }
      transport.reset();
      made_ = maker_.refine(std::move(made_), limit, store);
      ++round;
      transport = make_transport(options_.tolerance);
      error = verify(check, *transport);
    }
    finish(*transport, error, round);
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    transport->parts_.report.seconds = elapsed.count();
    return transport;
  }

  /// Makes only what a part of the work has of the first round.
  void make_part(WorkPart part, const RecordVisitor& visit) {
    open_store();
    maker_.make_part(first_limit(options_.tolerance), *store_, part);
    for (std::size_t k = part.number; k < store_->n_parts(); k += part.n_parts) {
      visit(store_->record(k));
    }
  }

 private:
  [[nodiscard]] double first_limit(double tolerance) const {
    const double n = std::max(static_cast<double>(mesh_.size()) / kFewPatches, 1.0);
    return square(tolerance / kOfRoot) / std::sqrt(n);
  }

  void open_store() {
    const std::filesystem::path& path = options_.work_file;
    if (path.empty() || !is_first(options_.ranks)) return;
    const std::uint64_t fingerprint = compressed_fingerprint(mesh_, options_, light_).value();
    if (options_.work_start == WorkStart::resumed &&
        block_file_state(path, fingerprint) == WorkFileState::other) {
      throw OutputError(path.string() +
                        ": belongs to another scene or other options, so it cannot be resumed");
    }
    store_.emplace(path, fingerprint, options_.work_start, options_.progress);
  }

  /// Makes a rough operator for who waits, and leaves nothing of it.
  void give_rough() {
    if (options_.progress.report) {
      progress_.report = [report = options_.progress.report](std::string_view stage, double done,
                                                             double total, std::string_view unit) {
        report("rough " + std::string(stage), done, total, unit);
      };
    }
    made_ = maker_.make(first_limit(kRoughTolerance));
    std::unique_ptr<CompressedTransport> transport = make_transport(kRoughTolerance);
    RowCheck check = make_check(*transport);
    check.add_rows(kRoughRows, progress_);
    tell(*transport, check.error(transport->apply(check.radiosity())), 0);
    options_.rough(std::move(transport));
    made_ = {};
    progress_.report = options_.progress.report;
  }

  /// The operator of the blocks so far, of which this tolerance is asked.
  std::unique_ptr<CompressedTransport> make_transport(double tolerance) {
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
                                   .area = area_,
                                   .report = report_of_pairs(),
                                   .ranks = options_.ranks});
    TransportOptions asked = options_;
    asked.tolerance = tolerance;
    close_with_light(*transport, lights_, mesh_, visibility_, asked);
    return transport;
  }

  [[nodiscard]] AssemblyReport report_of_pairs() const {
    AssemblyReport report;
    static_cast<Census&>(report) = made_.pairs;
    report.closed = is_closed_;
    report.covered = coverage_.share;
    return report;
  }

  [[nodiscard]] RowCheck make_check(const CompressedTransport& transport) const {
    Eigen::MatrixXd fields = test_fields(mesh_);
    if (light_.exitance.size() > 0 && light_.exitance.maxCoeff() > 0) {
      const Solution solution = solve(transport, light_.exitance, light_.reflectance,
                                      {.tolerance = kLightTolerance,
                                       .estimates_errors = false,
                                       .progress = {.report = {}, .stop = options_.progress.stop}});
      const Index n = fields.cols();
      fields.conservativeResize(Eigen::NoChange, n + solution.radiosity.cols());
      fields.rightCols(solution.radiosity.cols()) = solution.radiosity;
    }
    return {evaluator_,        mesh_.area,    likely_errors(transport),
            std::move(fields), options_.seed, options_.ranks};
  }

  [[nodiscard]] RowCheck::Error verify(RowCheck& check,
                                       const CompressedTransport& transport) const {
    return check.decide(transport.apply(check.radiosity()), options_.tolerance, options_.progress);
  }

  void finish(CompressedTransport& transport, const RowCheck::Error& error, int round) const {
    tell(transport, error, round);
    find_backs(transport, mesh_, visibility_, options_);
  }

  /// Lets the operator's report and errors tell what was verified.
  void tell(CompressedTransport& transport, const RowCheck::Error& error, int round) const {
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
  }

  const PatchMesh& mesh_;
  const Visibility& visibility_;
  const TransportOptions& options_;
  const ExpectedLight& light_;
  Eigen::VectorXd area_;
  Coverage coverage_;
  ExchangeEvaluator evaluator_;
  ClusterPolynomials polynomials_;
  Progress progress_;
  BlockMaker maker_;
  bool is_closed_ = false;
  std::vector<LightPolygon> lights_;
  std::optional<BlockStore> store_;
  MadeBlocks made_;
  double estimate_ = 0;  // of the relative error of F 1
};

void refuse_compressed_part() {
  throw SolveError(
      "compressed form factors do not know the scene's symmetry: use --transport dense or auto");
}

std::unique_ptr<CompressedTransport> make_compressed_transport(const PatchMesh& mesh,
                                                               const Visibility& visibility,
                                                               const TransportOptions& options,
                                                               const ExpectedLight& light) {
  if (!mesh.images.empty()) refuse_compressed_part();
  check_compressed_memory(mesh.size(), options.memory);
  return CompressedAssembly(mesh, visibility, options, light).make();
}

void make_compressed_part(const PatchMesh& mesh, const Visibility& visibility,
                          const TransportOptions& options, const ExpectedLight& light,
                          WorkPart part, const RecordVisitor& visit) {
  if (!mesh.images.empty()) refuse_compressed_part();
  check_compressed_memory(mesh.size(), options.memory);
  CompressedAssembly(mesh, visibility, options, light).make_part(part, visit);
}

Fingerprint compressed_fingerprint(const PatchMesh& mesh, const TransportOptions& options,
                                   const ExpectedLight& light) {
  Fingerprint fingerprint;
  fingerprint.add(kNumbersVersion);
  add_patches(fingerprint, mesh);
  fingerprint.add(options.tolerance);
  fingerprint.add(options.closed);
  fingerprint.add(options.seed);
  for (const Eigen::MatrixXd* values : {&light.exitance, &light.reflectance, &light.emitted}) {
    fingerprint.add(values->rows());
    fingerprint.add(std::as_bytes(std::span(values->data(), values->size())));
  }
  return fingerprint;
}

std::size_t compressed_transport_bytes(Index n_patches) {
  return static_cast<std::size_t>(kBytesOfPatch * static_cast<double>(n_patches));
}

void check_compressed_memory(Index n_patches, std::size_t memory) {
  const std::size_t limit = memory_limit(memory);
  const std::size_t needed = compressed_transport_bytes(n_patches);
  if (needed <= limit) return;
  const auto fits = static_cast<Index>(static_cast<double>(limit) / kBytesOfPatch);
  throw MemoryShortage("the compressed form factors of " + std::to_string(n_patches) +
                       " patches need some " + gigabytes(needed) + " of memory, but " +
                       gigabytes(limit) + " can be used: use --patches " + std::to_string(fits) +
                       " or a scene of fewer polygons");
}

}  // namespace radiosity
