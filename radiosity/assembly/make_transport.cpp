#include "radiosity/assembly/make_transport.h"

#include <chrono>
#include <cmath>

#include "radiosity/assembly/assembly_report.h"
#include "radiosity/assembly/closure.h"
#include "radiosity/assembly/dense_memory.h"
#include "radiosity/assembly/memory_sink.h"
#include "radiosity/operator/patch_order.h"
#include "radiosity/visibility/coverage.h"

namespace radiosity {
namespace {

class DenseTransport final : public Transport, public FactorRows {
 public:
  DenseTransport(Assembly assembly, Eigen::VectorXd area)
      : order_(std::move(assembly.order)),
        tiles_(std::move(assembly.tiles)),
        area_(std::move(area)),
        report_(std::move(assembly.report)) {
    const Eigen::MatrixXd inverse_area = order_.to_rows(area_.cwiseInverse());
    // ‖ΔF̂‖_F² = Σ σ_ij² / (A_i A_j)
    error_ = std::sqrt(inverse_area.col(0).dot(tiles_.error_product(inverse_area).col(0)));
  }

  [[nodiscard]] Index size() const override { return area_.size(); }
  [[nodiscard]] const Eigen::VectorXd& area() const override { return area_; }

  [[nodiscard]] Eigen::MatrixXd apply(const Eigen::MatrixXd& radiosity) const override {
    Eigen::MatrixXd result = order_.to_patches(tiles_.product(order_.to_rows(radiosity)));
    result.array().colwise() /= area_.array();
    return result;
  }

  [[nodiscard]] Eigen::VectorXd row(Index i) const override {
    return order_.to_patches(tiles_.row(order_.row(i))) / area_[i];
  }

  [[nodiscard]] Eigen::VectorXd row_error(Index i) const override {
    return order_.to_patches(tiles_.row_error(order_.row(i))) / area_[i];
  }

  [[nodiscard]] ExchangeArea pair(Index i, Index j) const override {
    return tiles_.entry(order_.row(i), order_.row(j));
  }

  [[nodiscard]] Eigen::MatrixXd apply_error(const Eigen::MatrixXd& radiosity) const override {
    const Eigen::MatrixXd squares = order_.to_rows(radiosity.cwiseAbs2());
    Eigen::MatrixXd result = order_.to_patches(tiles_.error_product(squares)).cwiseSqrt();
    result.array().colwise() /= area_.array();
    return result;
  }

  [[nodiscard]] double error() const override { return error_; }
  [[nodiscard]] std::size_t bytes() const override { return tiles_.bytes(); }
  [[nodiscard]] const AssemblyReport& report() const override { return report_; }
  [[nodiscard]] const FactorRows* rows() const override { return this; }

 private:
  PatchOrder order_;  // of the tiles' rows
  ExchangeMatrix tiles_;
  Eigen::VectorXd area_;
  AssemblyReport report_;
  double error_ = 0;
};

}  // namespace

std::unique_ptr<Transport> make_transport(const PatchMesh& mesh, const Visibility& visibility,
                                          const TransportOptions& options) {
  check_memory(mesh.size(), mesh.n_polygons(), options.memory);
  const auto start = std::chrono::steady_clock::now();
  const Eigen::VectorXd area = Eigen::Map<const Eigen::VectorXd>(mesh.area.data(), mesh.size());
  const Coverage coverage = find_coverage(mesh, plane_thickness(mesh));
  Assembly assembly = assemble_exchange_areas(mesh, visibility, options, coverage);
  const Eigen::VectorXd open_area = (area.array() * (1 - coverage.share.array()))(assembly.order);
  assembly.tiles.set_row_sums(assembly.row_sums);
  const ClosedRows rows =
      close_rows(assembly.tiles, assembly.row_sums, open_area, options.closed, options.tolerance);
  assembly.tiles.set_row_sums(rows.sums.present);
  assembly.report.closed = rows.is_closed;
  find_backs(mesh, visibility, assembly.order, rows.sums.present, rows.open_rows, options.seed,
             assembly.report);
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  assembly.report.seconds = elapsed.count();
  return std::make_unique<DenseTransport>(std::move(assembly), area);
}

}  // namespace radiosity
