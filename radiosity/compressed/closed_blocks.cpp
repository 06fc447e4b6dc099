#include "radiosity/compressed/closed_blocks.h"

#include <utility>
#include <vector>

#include "radiosity/assembly/assembly_report.h"
#include "radiosity/assembly/balance.h"

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

Eigen::ArrayXd gaps(const AssemblyReport& report) {
  return 1 - report.covered.array() - report.row_sums.array();
}

/// Rows that lack more than errors explain: whether, in the order of the patches.
Eigen::Array<bool, Eigen::Dynamic, 1> are_open(const CompressedTransport& transport,
                                               double tolerance) {
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(transport.size());
  const double own = kSigmas / transport.parts().error_scale;
  const Eigen::ArrayXd most = own * transport.apply_error(ones).col(0).array();
  return gaps(transport.report()).abs() > most + kSigmas * tolerance;
}

/// Changes the densities until rows, of which these are the sums as they stand, sum to 1.
void close(CompressedTransport& transport, const Eigen::VectorXd& row_sums, double tolerance) {
  const PatchOrder& order = transport.order();
  const Eigen::VectorXd& area = transport.area();
  const AssemblyReport& report = transport.report();
  const Eigen::VectorXd mask = (!are_open(transport, tolerance)).cast<double>();
  RowSums sums{order.to_rows(area.cwiseProduct(row_sums)).col(0),
               order.to_rows(area.array() * (1 - report.covered.array())).col(0),
               order.to_rows(mask).col(0)};
  AdjustableBlocks exchange(transport.matrix(), order.to_rows(area).col(0), sums.present);
  balance_rows(exchange, sums, kRounds);
  transport.set_multipliers(exchange.multipliers());
}

}  // namespace

void close_blocks(CompressedTransport& transport, double tolerance) {
  AssemblyReport report = transport.report();
  report.row_sums = transport.apply(Eigen::VectorXd::Ones(transport.size()));
  if (transport.size() > 0) {
    report.closure_mean = gaps(report).abs().mean();
    report.closure_max = gaps(report).abs().maxCoeff();
  }
  transport.set_report(std::move(report));
  if (!transport.report().closed) return;
  close(transport, transport.report().row_sums, tolerance);
}

void close_again(CompressedTransport& transport, double tolerance) {
  if (!transport.report().closed) return;
  transport.set_multipliers({});
  close(transport, transport.apply(Eigen::VectorXd::Ones(transport.size())), tolerance);
}

void find_backs(CompressedTransport& transport, const PatchMesh& mesh, const Visibility& visibility,
                const TransportOptions& options) {
  AssemblyReport report = transport.report();
  const Eigen::VectorXd present = transport.apply(Eigen::VectorXd::Ones(transport.size()));
  std::vector<Index> open_rows;
  if (report.closed) {
    const Eigen::VectorXd is_open = are_open(transport, options.tolerance).cast<double>();
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
