#include "radiosity/compressed/closed_blocks.h"

#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "radiosity/assembly/assembly_report.h"
#include "radiosity/assembly/balance.h"
#include "radiosity/exchange/openings.h"

namespace radiosity {
namespace {

/// Rows off by more than so many of their errors, and the tolerance, are no errors but openings.
constexpr double kSigmas = 8;
constexpr int kRounds = 2;

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

/// What rows lack of 1, but for what is covered.
Eigen::ArrayXd gaps(const AssemblyReport& report, const Eigen::VectorXd& row_sums) {
  return 1 - report.covered.array() - row_sums.array();
}

/// What rows may be off by.
Eigen::ArrayXd most_off(const CompressedTransport& transport, double tolerance) {
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(transport.size());
  const double own = kSigmas / transport.parts().error_scale;
  return own * transport.apply_error(ones).col(0).array() + kSigmas * tolerance;
}

}  // namespace

ClosedSums find_closed_sums(CompressedTransport& transport, const PatchMesh& mesh,
                            const Visibility& visibility, const TransportOptions& options) {
  AssemblyReport report = transport.report();
  report.row_sums = transport.apply(Eigen::VectorXd::Ones(transport.size()));
  const Eigen::ArrayXd gap = gaps(report, report.row_sums);
  if (transport.size() > 0) {
    report.closure_mean = gap.abs().mean();
    report.closure_max = gap.abs().maxCoeff();
  }
  transport.set_report(report);
  if (!report.closed) return {};
  const Eigen::ArrayXd most = most_off(transport, options.tolerance);
  ClosedSums sums{1 - report.covered.array(), Eigen::VectorXd::Ones(transport.size())};
  std::vector<std::int32_t> lacking;
  for (Index i = 0; i < transport.size(); ++i) {
    if (gap[i] > most[i]) lacking.push_back(static_cast<std::int32_t>(i));
  }
  const auto open = open_shares(mesh, visibility, report.covered, lacking, options.seed);
  for (std::size_t k = 0; k < lacking.size(); ++k) {
    const std::int32_t i = lacking[k];
    const bool is_told = gap[i] - open[k].share <= most[i] + kSigmas * open[k].error;
    const bool is_opening = open[k].share > options.tolerance;
    if (std::isnan(open[k].share) || (is_opening && is_told)) {
      sums.mask[i] = 0;
    } else {
      sums.wanted[i] -= is_opening ? open[k].share : 0;
    }
  }
  return sums;
}

void close_blocks(CompressedTransport& transport, const ClosedSums& sums) {
  if (sums.mask.size() == 0) return;
  transport.set_multipliers({});
  const PatchOrder& order = transport.order();
  const Eigen::VectorXd& area = transport.area();
  const Eigen::VectorXd present = transport.apply(Eigen::VectorXd::Ones(transport.size()));
  RowSums rows{order.to_rows(area.cwiseProduct(present)).col(0),
               order.to_rows(area.cwiseProduct(sums.wanted)).col(0),
               order.to_rows(sums.mask).col(0)};
  AdjustableBlocks exchange(transport.matrix(), order.to_rows(area).col(0), rows.present);
  balance_rows(exchange, rows, kRounds);
  transport.set_multipliers(exchange.multipliers());
}

void find_backs(CompressedTransport& transport, const PatchMesh& mesh, const Visibility& visibility,
                const TransportOptions& options) {
  AssemblyReport report = transport.report();
  const Eigen::VectorXd present = transport.apply(Eigen::VectorXd::Ones(transport.size()));
  std::vector<Index> open_rows;
  if (report.closed) {
    const Eigen::VectorXd is_open =
        (gaps(report, present) > most_off(transport, options.tolerance)).cast<double>();
    const Eigen::VectorXd rows = transport.order().to_rows(is_open);
    for (Index row = 0; row < rows.size(); ++row) {
      if (rows[row] != 0) open_rows.push_back(row);
    }
  }
  const Eigen::VectorXd power = present.cwiseProduct(transport.area());
  find_backs(mesh, visibility, transport.parts().order, transport.order().to_rows(power), open_rows,
             options.seed, report);
  transport.set_report(std::move(report));
}

}  // namespace radiosity
