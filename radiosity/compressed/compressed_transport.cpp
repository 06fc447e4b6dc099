#include "radiosity/compressed/compressed_transport.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include "radiosity/base/parallel.h"
#include "radiosity/compressed/group_squares.h"

namespace radiosity {
namespace {

constexpr Index kPartSize = 4096;

}  // namespace

CompressedTransport::CompressedTransport(Parts parts)
    : parts_(std::move(parts)),
      order_(parts_.order),
      matrix_(std::move(parts_.blocks), parts_.ranks) {}

void CompressedTransport::add_source(Parts::Source source) {
  const auto own =
      std::find_if(parts_.sources.begin(), parts_.sources.end(),
                   [&](const Parts::Source& known) { return known.patches == source.patches; });
  if (own == parts_.sources.end()) {
    parts_.sources.push_back(std::move(source));
  } else {
    own->lacking += source.lacking;
  }
}

Eigen::MatrixXd CompressedTransport::apply(const Eigen::MatrixXd& radiosity) const {
  const CountedProduct counted(parts_.ranks);
  Eigen::MatrixXd result(radiosity.rows(), radiosity.cols());
  for (Index first = 0; first < radiosity.cols();) {
    const Index width = CompressedMatrix::width_of(radiosity.cols() - first);
    const Index n_columns = std::min(width, radiosity.cols() - first);
    const CompressedMatrix::Rows power =
        order_.to_rows(radiosity, parts_.area, first, n_columns, width);
    CompressedMatrix::Rows gathered = matrix_.product(power);
    if (parts_.multipliers.size() > 0) matrix_.add_changes(parts_.multipliers, power, gathered);
    order_.to_patches(gathered, first, n_columns, result);
    first += n_columns;
  }
  add_lacking(radiosity, result);
  return result;
}

/// Adds Σ_s (r vᵀ + v rᵀ - (Σ r) v vᵀ) x / A over the sources, v those of their patches.
void CompressedTransport::add_lacking(const Eigen::MatrixXd& x, Eigen::MatrixXd& result) const {
  if (parts_.sources.empty()) return;
  const auto n_sources = static_cast<Index>(parts_.sources.size());
  const Index n_parts = (size() + kPartSize - 1) / kPartSize;
  const auto range = [&](Index part) {
    return std::pair(part * kPartSize, std::min(kPartSize, size() - part * kPartSize));
  };
  // Of rᵀ x, with a row for each source. Parts are added in their order.
  std::vector<Eigen::MatrixXd> products(n_parts);
  parallel_for(n_parts, [&](Index part) {
    const auto [begin, n] = range(part);
    products[part].resize(n_sources, x.cols());
    for (Index s = 0; s < n_sources; ++s) {
      products[part].row(s) =
          parts_.sources[s].lacking.segment(begin, n).transpose() * x.middleRows(begin, n);
    }
  });
  Eigen::MatrixXd product = Eigen::MatrixXd::Zero(n_sources, x.cols());
  for (const Eigen::MatrixXd& part : products) product += part;

  Eigen::MatrixXd mean = Eigen::MatrixXd::Zero(n_sources, x.cols());
  for (Index s = 0; s < n_sources; ++s) {
    const Parts::Source& source = parts_.sources[s];
    double area = 0;
    double own = 0;
    for (const std::int32_t j : source.patches) {
      area += parts_.area[j];
      own += source.lacking[j];
      mean.row(s) += parts_.area[j] * x.row(j);
    }
    mean.row(s) /= area;
    const Eigen::RowVectorXd back = (product.row(s) - own * mean.row(s)) / area;
    for (const std::int32_t j : source.patches) result.row(j) += back;
  }
  parallel_for(n_parts, [&](Index part) {
    const auto [begin, n] = range(part);
    for (Index s = 0; s < n_sources; ++s) {
      const Eigen::VectorXd density =
          parts_.sources[s].lacking.segment(begin, n).cwiseQuotient(parts_.area.segment(begin, n));
      result.middleRows(begin, n).noalias() += density * mean.row(s);
    }
  });
}

Eigen::MatrixXd CompressedTransport::apply_error(const Eigen::MatrixXd& radiosity) const {
  const Eigen::MatrixXd power = order_.to_rows(radiosity.cwiseAbs(), parts_.area);
  return parts_.error_scale * order_.to_patches(matrix_.squared_errors(power)).cwiseSqrt();
}

double CompressedTransport::error() const {
  if (size() == 0) return 0;
  return 2 * apply_error(Eigen::VectorXd::Ones(size())).maxCoeff();
}

std::size_t CompressedTransport::bytes() const {
  return matrix_.bytes() + sizeof(double) * (parts_.area.size() + parts_.multipliers.size()) +
         sizeof(double) * parts_.area.size() * parts_.sources.size() +
         sizeof(std::int32_t) * parts_.order.size() + order_.bytes();
}

Eigen::VectorXd CompressedTransport::row(Index i) const {
  return row_of_column(i, apply(Eigen::VectorXd::Unit(size(), i)));
}

Eigen::VectorXd CompressedTransport::row_error(Index i) const {
  return row_of_column(i, apply_error(Eigen::VectorXd::Unit(size(), i)));
}

/// Row i of F from its column i: G is symmetric, and F_ij = G_ij / A_i.
Eigen::VectorXd CompressedTransport::row_of_column(Index i, const Eigen::VectorXd& column) const {
  return column.cwiseProduct(parts_.area) / parts_.area[i];
}

double CompressedTransport::lacking_density(const Parts::Source& source, Index i, Index j) const {
  const auto holds = [&](Index patch) {
    return std::binary_search(source.patches.begin(), source.patches.end(), patch);
  };
  double area = 0;
  double own = 0;
  for (const std::int32_t k : source.patches) {
    area += parts_.area[k];
    own += source.lacking[k];
  }
  const bool has_i = holds(i);
  const bool has_j = holds(j);
  double sum = 0;
  if (has_j) sum += source.lacking[i] / parts_.area[i] / area;
  if (has_i) sum += source.lacking[j] / parts_.area[j] / area;
  if (has_i && has_j) sum -= own / (area * area);
  return sum;
}

ExchangeArea CompressedTransport::pair(Index i, Index j) const {
  auto [density, error, may_change] = matrix_.entry(order_.row(i), order_.row(j));
  if (may_change && parts_.multipliers.size() > 0) {
    density +=
        square(error) * (parts_.multipliers[order_.row(i)] + parts_.multipliers[order_.row(j)]);
  }
  const double areas = parts_.area[i] * parts_.area[j];
  for (const Parts::Source& source : parts_.sources) density += lacking_density(source, i, j);
  return {density * areas, parts_.error_scale * error * areas, error == 0};
}

Eigen::MatrixXd CompressedTransport::sums(const PatchMesh& mesh, const Eigen::MatrixXd& x,
                                          const Weight& weight) const {
  std::vector<CompressedMatrix::Place> places(size());
  for (Index row = 0; row < size(); ++row) {
    const std::int32_t patch = parts_.order[row];
    places[row] = {mesh.centroid[patch], std::sqrt(mesh.area[patch])};
  }
  return order_.to_patches(matrix_.weighted_sums(places, order_.to_rows(x), weight));
}

Eigen::VectorXd CompressedTransport::squares_of_groups(const NeighborGroups& groups,
                                                       const Eigen::VectorXd& x,
                                                       const Eigen::VectorXd& weight,
                                                       const Progress& progress) const {
  // A worker has a number for each node.
  const Index n_together = std::max<Index>(64, groups.n_groups / 1024);
  // The rows of each group follow each other.
  std::vector<std::int32_t> rows(size());
  std::iota(rows.begin(), rows.end(), 0);
  const auto group_of = [&](std::int32_t row) { return groups.group_of[parts_.order[row]]; };
  std::stable_sort(rows.begin(), rows.end(), [&](std::int32_t one, std::int32_t other) {
    return group_of(one) < group_of(other);
  });
  std::vector<Index> first(groups.n_groups + 1, 0);
  for (const std::int32_t group : groups.group_of) ++first[group + 1];
  std::partial_sum(first.begin(), first.end(), first.begin());

  const GroupSquares squares(matrix_, order_.to_rows(weight));
  const Eigen::VectorXd values = order_.to_rows(x);
  Eigen::VectorXd result(groups.n_groups);
  parallel_for((groups.n_groups + n_together - 1) / n_together, [&](std::ptrdiff_t part) {
    progress.check();
    GroupSquares::Worker worker(squares);
    for (Index g = part * n_together; g < std::min(groups.n_groups, (part + 1) * n_together); ++g) {
      const std::span<const std::int32_t> of_group(rows.data() + first[g], first[g + 1] - first[g]);
      result[g] = squares(of_group, values, worker);
    }
  });
  return result;
}

}  // namespace radiosity
