#include "radiosity/compressed/closed_blocks.h"

#include <utility>

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

/// Changes the densities until rows sum to 1.
void close(CompressedTransport& transport, const Eigen::ArrayXd& gap, double tolerance,
           AssemblyReport& report) {
  const PatchOrder& order = transport.order();
  const Eigen::VectorXd& area = transport.area();
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(transport.size());
  const double own = kSigmas / transport.parts().error_scale;
  const Eigen::ArrayXd most =
      own * transport.apply_error(ones).col(0).array() + kSigmas * tolerance;
  const Eigen::VectorXd mask = (gap.abs() <= most).cast<double>();
  RowSums sums{order.to_rows(area.cwiseProduct(report.row_sums)).col(0),
               order.to_rows(area.array() * (1 - report.covered.array())).col(0),
               order.to_rows(mask).col(0)};
  AdjustableBlocks exchange(transport.matrix(), order.to_rows(area).col(0), sums.present);
  balance_rows(exchange, sums, kRounds);
  report.open_rows = static_cast<std::int64_t>((mask.array() == 0).count());
  transport.set_closure(exchange.multipliers(), report);
}

}  // namespace

void close_blocks(CompressedTransport& transport, double tolerance) {
  AssemblyReport report = transport.report();
  report.row_sums = transport.apply(Eigen::VectorXd::Ones(transport.size()));
  const Eigen::ArrayXd gap = 1 - report.covered.array() - report.row_sums.array();
  report.closure_mean = gap.abs().mean();
  report.closure_max = gap.abs().maxCoeff();
  if (report.closed) close(transport, gap, tolerance, report);
  transport.set_closure(transport.parts().multipliers, std::move(report));
}

void find_backs(CompressedTransport& transport, const PatchMesh& mesh, const Visibility& visibility,
                std::uint64_t seed) {
  AssemblyReport report = transport.report();
  const Eigen::VectorXd present = transport.apply(Eigen::VectorXd::Ones(transport.size()));
  const Eigen::VectorXd missing = 1 - report.covered.array() - present.array();
  report.backs = shares_on_backs(mesh, visibility, missing, seed);
  transport.set_closure(transport.parts().multipliers, std::move(report));
}

}  // namespace radiosity
