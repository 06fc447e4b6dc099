#include "radiosity/stream/streamed_factors.h"

#include <chrono>
#include <cmath>
#include <utility>

#include "radiosity/assembly/assembly_report.h"
#include "radiosity/assembly/exchange_assembly.h"
#include "radiosity/assembly/shared_tiles.h"
#include "radiosity/assembly/tile_sum.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/scene/whole_mesh.h"
#include "radiosity/visibility/coverage.h"
#include "radiosity/visibility/visibility.h"

namespace radiosity {
namespace {

/// To be raised whenever the same scene and options give other numbers than before.
constexpr int kNumbersVersion = 5;
/// Rounds of the closure correction; each costs passes through the uncertain entries. It has ended
/// by then, or has only rows left that StoredBalance mends better.
constexpr int kClosureRounds = 6;
/// A row sum further than this from what it should be has not been balanced. Relative.
constexpr double kUnbalanced = 1e-10;

/// Of a rank that keeps none.
class NoTiles final : public TileSink {
 public:
  void start(const TileLayout& /*layout*/) override {}
  [[nodiscard]] bool has(Index /*row_strip*/, Index /*column_strip*/) const override {
    return false;
  }
  void put(ExchangeTile /*tile*/) override {}
};

double largest_gap(const RowSums& sums) {
  return sums.mask.cwiseProduct(sums.wanted - sums.present).cwiseAbs().maxCoeff();
}

}  // namespace

TransportOptions assembly_options(const StreamOptions& options) {
  return {.tolerance = options.tolerance,
          .closed = options.closed,
          .seed = options.seed,
          .ranks = options.ranks,
          .progress = options.progress};
}

Fingerprint stream_fingerprint(const PatchMesh& mesh, const StreamOptions& options) {
  Fingerprint fingerprint;
  fingerprint.add(kNumbersVersion);
  add_patches(fingerprint, mesh);
  fingerprint.add(options.tolerance);
  fingerprint.add(options.closed);
  fingerprint.add(options.seed);
  fingerprint.add(options.min_factor);
  return fingerprint;
}

StreamedFactors::StreamedFactors(const PatchMesh& mesh, const Visibility& visibility,
                                 const StreamOptions& options, TileStore& store)
    : mesh_(mesh), options_(options), store_(store) {
  const auto start = std::chrono::steady_clock::now();
  const WholeMesh whole(mesh);
  const Coverage coverage = find_coverage(whole.mesh(), plane_thickness(whole.mesh()));
  const Eigen::VectorXd covered = coverage.share.head(mesh.size());
  if (options.ranks != nullptr) {
    share_tiles(whole, visibility, assembly_options(options), coverage, TileKeeper::first, store);
  } else {
    assemble_tiles(whole, visibility, assembly_options(options), coverage, store);
  }
  const Eigen::VectorXd row_sums = store.totals().row_sums();
  report_ =
      make_report(store.totals().census(), row_sums, store.layout().order, mesh.area, covered);
  const Eigen::VectorXd areas = areas_of_rows();
  const Eigen::VectorXd open = (1 - covered.array())(store.layout().order);
  RowSums sums = close(visibility, row_sums, areas.cwiseProduct(open));
  if (options.min_factor > 0) sums.mask.setOnes();
  balance_.emplace(*closure_, areas, options.min_factor, sums.mask);
  if (options.min_factor > 0) {
    drop(sums);
  } else {
    balance(sums);
  }
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  report_.seconds = elapsed.count();
}

Eigen::VectorXd StreamedFactors::areas_of_rows() const {
  const std::vector<std::int32_t>& order = store_.layout().order;
  Eigen::VectorXd areas(mesh_.size());
  for (Index row = 0; row < areas.size(); ++row) areas[row] = mesh_.area[order[row]];
  return areas;
}

/// Corrects closure.
RowSums StreamedFactors::close(const Visibility& visibility, const Eigen::VectorXd& row_sums,
                               const Eigen::VectorXd& areas) {
  closure_.emplace(store_, options_.buffers);
  ClosedRows rows =
      close_rows(*closure_, row_sums, areas, options_.closed, options_.tolerance, kClosureRounds);
  report_.closed = rows.is_closed;
  find_backs(mesh_, visibility, store_.layout().order, rows.sums.present, rows.open_rows,
             options_.seed, report_);
  closure_->release_memory();
  return std::move(rows.sums);
}

/// Balances what dropping the smallest pairs has left.
void StreamedFactors::drop(RowSums& sums) {
  const StoredBalance::Dropped dropped = balance_->dropped();
  const double total = sums.present.sum();
  const Eigen::VectorXd shares =
      (sums.present.array() > 0).select(dropped.exchange.cwiseQuotient(sums.present), 0);
  sums.present = balance_->row_sums();
  balance(sums);
  dropped_.entries = static_cast<std::int64_t>(dropped.entries.sum());
  dropped_.share = total > 0 ? dropped.exchange.sum() / total : 0;
  dropped_.largest_row_share = shares.size() > 0 ? shares.maxCoeff() : 0;
  dropped_.unbalanced_rows =
      ((sums.wanted - sums.present).array().abs() > kUnbalanced * sums.wanted.array()).count();
}

/// Makes the sums as wanted, round by round, as long as that brings them nearer.
void StreamedFactors::balance(RowSums& sums) {
  for (int round = 0; round < kBalanceRounds; ++round) {
    options_.progress.check();
    const Eigen::VectorXd before = sums.present;
    const double gap = largest_gap(sums);
    balance_rows(*balance_, sums, 1);
    if (largest_gap(sums) < gap) continue;
    if (sums.present != before) {
      balance_->undo();
      sums.present = before;
    }
    return;
  }
}

void StreamedFactors::for_each_row(const RowVisitor& visit) const {
  stream_rows(*balance_, store_.layout(), mesh_.area, visit,
              {.memory = options_.buffers, .progress = options_.progress});
}

void assist_streamed_factors(const PatchMesh& mesh, const Visibility& visibility,
                             const StreamOptions& options) {
  const WholeMesh whole(mesh);
  const Coverage coverage = find_coverage(whole.mesh(), plane_thickness(whole.mesh()));
  NoTiles none;
  share_tiles(whole, visibility, assembly_options(options), coverage, TileKeeper::first, none);
}

Eigen::VectorXd row_error_of(const StreamedFactors& factors, Index row) {
  Eigen::VectorXd result;
  factors.for_each_row([&](Index i, const Eigen::VectorXd& /*row*/, const Eigen::VectorXd& error) {
    if (i == row) result = error;
  });
  return result;
}

}  // namespace radiosity
