#include "radiosity/compressed/cluster_polynomials.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "radiosity/base/parallel.h"

namespace radiosity {
namespace {

/// Polynomials that are so small, next to the coordinates' size, once those before are taken out of
/// them, are no functions of their own.
constexpr double kSmallest = 1e-3;
/// Clusters of more patches are built in parallel.
constexpr Index kSerial = 2048;

/// Orthonormal columns by rising degree out of those of `candidates`, within a degree the largest
/// first, and their coefficients.
struct Orthonormal {
  Eigen::MatrixXd columns;       // rows x count
  Eigen::MatrixXd coefficients;  // count x candidates: columns = candidates coefficientsᵀ
  std::array<std::uint8_t, NestedBasis::kMostDegree + 1> counts{};
};

Orthonormal orthonormalised(const Eigen::MatrixXd& candidates, const PolynomialSpace& space) {
  const Index n = candidates.cols();
  const Index most = std::min<Index>({n, candidates.rows(), ClusterPolynomials::kMost});
  Orthonormal result;
  result.columns.resize(candidates.rows(), most);
  result.coefficients = Eigen::MatrixXd::Zero(most, n);
  Eigen::MatrixXd left = candidates;
  Eigen::MatrixXd left_coefficients = Eigen::MatrixXd::Identity(n, n);
  Index count = 0;
  Index begin = 0;
  for (int degree = 0; degree <= NestedBasis::kMostDegree; ++degree) {
    const Index end = degree <= space.degree() ? space.size(degree) : n;
    std::vector<Index> open;
    for (Index k = begin; k < end; ++k) open.push_back(k);
    while (!open.empty() && count < most) {
      const auto largest = std::max_element(open.begin(), open.end(), [&](Index a, Index b) {
        return left.col(a).squaredNorm() < left.col(b).squaredNorm();
      });
      const Index k = *largest;
      open.erase(largest);
      // Once more, for what rounding left.
      for (Index q = 0; q < count; ++q) {
        const double share = result.columns.col(q).dot(left.col(k));
        left.col(k) -= share * result.columns.col(q);
        left_coefficients.col(k) -= share * result.coefficients.row(q).transpose();
      }
      const double norm = left.col(k).norm();
      if (norm < kSmallest) break;
      result.columns.col(count) = left.col(k) / norm;
      result.coefficients.row(count) = left_coefficients.col(k).transpose() / norm;
      for (Index later = begin; later < n; ++later) {
        const double share = result.columns.col(count).dot(left.col(later));
        left.col(later) -= share * result.columns.col(count);
        left_coefficients.col(later) -= share * result.coefficients.row(count).transpose();
      }
      ++count;
    }
    begin = end;
    result.counts[degree] = static_cast<std::uint8_t>(count);
  }
  result.columns.conservativeResize(Eigen::NoChange, count);
  result.coefficients.conservativeResize(count, Eigen::NoChange);
  return result;
}

}  // namespace

ClusterPolynomials::ClusterPolynomials(const PatchMesh& mesh, const ClusterTree& tree)
    : mesh_(mesh), tree_(tree), planar_(2, kMostDegree), curved_(6, kMostCurvedDegree) {
  frames_.resize(tree.clusters.size());
  built_.resize(tree.clusters.size());
  if (!tree.clusters.empty()) build(0, nullptr);
}

ClusterPolynomials::Frame ClusterPolynomials::make_frame(std::int32_t cluster,
                                                         const Frame* plane) const {
  const Cluster& its = tree_.clusters[cluster];
  Frame frame;
  double area = 0;
  for (Index k = its.begin; k < its.end; ++k) {
    const std::int32_t patch = tree_.order[k];
    frame.center += mesh_.area[patch] * mesh_.centroid[patch];
    frame.normal += mesh_.area[patch] * mesh_.normal[patch];
    area += mesh_.area[patch];
  }
  frame.center /= area;
  frame.normal /= area;
  double radius = 0;
  for (Index k = its.begin; k < its.end; ++k) {
    radius = std::max(radius, (mesh_.centroid[tree_.order[k]] - frame.center).norm());
  }
  if (radius > 0) frame.size = radius;
  frame.is_planar = plane != nullptr || its.plane.has_value();
  if (plane != nullptr) {
    frame.u = plane->u;
    frame.v = plane->v;
  } else if (its.plane) {
    frame.u = its.plane->normal.unitOrthogonal();
    frame.v = its.plane->normal.cross(frame.u);
  }
  return frame;
}

void ClusterPolynomials::coordinates(const Frame& frame, std::int32_t patch,
                                     double* point) const {
  const Vec3 place = (mesh_.centroid[patch] - frame.center) / frame.size;
  if (frame.is_planar) {
    point[0] = frame.u.dot(place);
    point[1] = frame.v.dot(place);
    return;
  }
  const Vec3 normal = mesh_.normal[patch] - frame.normal;
  for (int axis = 0; axis < 3; ++axis) {
    point[axis] = place[axis];
    point[3 + axis] = normal[axis];
  }
}

Eigen::MatrixXd ClusterPolynomials::coordinate_map(const Frame& outer, const Frame& inner) {
  const int n_inner = inner.is_planar ? 2 : 6;
  const int n_outer = outer.is_planar ? 2 : 6;
  // Place, in sizes of the outer, and normal.
  Eigen::Matrix<double, 6, Eigen::Dynamic> all =
      Eigen::Matrix<double, 6, Eigen::Dynamic>::Zero(6, 1 + n_inner);
  all.col(0).head<3>() = (inner.center - outer.center) / outer.size;
  all.col(0).tail<3>() = inner.normal - outer.normal;
  const double scale = inner.size / outer.size;
  if (inner.is_planar) {
    all.col(1).head<3>() = scale * inner.u;
    all.col(2).head<3>() = scale * inner.v;
  } else {
    for (int axis = 0; axis < 3; ++axis) {
      all(axis, 1 + axis) = scale;
      all(3 + axis, 4 + axis) = 1;
    }
  }
  if (!outer.is_planar) return all;
  Eigen::MatrixXd result(n_outer, 1 + n_inner);
  result.row(0) = outer.u.transpose() * all.topRows<3>();
  result.row(1) = outer.v.transpose() * all.topRows<3>();
  return result;
}

Eigen::MatrixXd ClusterPolynomials::build(std::int32_t cluster, const Frame* plane) {
  const Cluster& its = tree_.clusters[cluster];
  const Frame& frame = frames_[cluster] = make_frame(cluster, plane);
  const PolynomialSpace& monomials = space(frame);
  Built& built = built_[cluster];
  Eigen::MatrixXd candidates;
  Eigen::VectorXd scale;  // of the rows, so that the columns' norms are means over the area
  if (its.is_leaf()) {
    const Index n = its.end - its.begin;
    candidates.resize(n, monomials.size());
    scale.resize(n);
    std::array<double, 6> point{};
    std::array<double, kMost> values{};
    for (Index k = 0; k < n; ++k) {
      const std::int32_t patch = tree_.order[its.begin + k];
      coordinates(frame, patch, point.data());
      monomials.evaluate(point.data(), values.data());
      for (int m = 0; m < monomials.size(); ++m) candidates(k, m) = values[m];
      scale[k] = std::sqrt(mesh_.area[patch]);
      built.area += mesh_.area[patch];
    }
  } else {
    const Frame* shared = frame.is_planar ? &frame : nullptr;
    const std::array<std::int32_t, 2> children{its.left, its.right};
    std::array<Eigen::MatrixXd, 2> below;
    const auto build_child = [&](std::ptrdiff_t k) { below[k] = build(children[k], shared); };
    if (its.end - its.begin > kSerial) {
      parallel_for(2, build_child);
    } else {
      build_child(0);
      build_child(1);
    }
    candidates = Eigen::MatrixXd::Zero(below[0].rows() + below[1].rows(), monomials.size());
    scale.resize(candidates.rows());
    Index row = 0;
    for (int k = 0; k < 2; ++k) {
      const Frame& inner = frames_[children[k]];
      const Eigen::MatrixXd substituted =
          monomials.substituted(coordinate_map(frame, inner), space(inner));
      candidates.block(row, 0, below[k].rows(), substituted.rows()) =
          below[k].leftCols(substituted.cols()) * substituted.transpose();
      scale.segment(row, below[k].rows()).setConstant(std::sqrt(built_[children[k]].area));
      row += below[k].rows();
      built.area += built_[children[k]].area;
    }
  }
  scale /= std::sqrt(built.area);
  candidates.array().colwise() *= scale.array();
  const Orthonormal found = orthonormalised(candidates, monomials);
  built.counts = found.counts;
  built.coefficients = found.coefficients.cast<float>();
  built.below = (scale.cwiseInverse().asDiagonal() * found.columns).cast<float>();
  return found.columns.transpose() * candidates;
}

void ClusterPolynomials::evaluate(std::int32_t cluster, std::int32_t patch, int degree,
                                  double* values) const {
  const Frame& frame = frames_[cluster];
  const PolynomialSpace& monomials = space(frame);
  std::array<double, 6> point{};
  std::array<double, kMost> powers{};
  coordinates(frame, patch, point.data());
  monomials.evaluate(point.data(), powers.data());
  const Eigen::MatrixXf& coefficients = built_[cluster].coefficients;
  int k = 0;
  for (int d = 0; d <= degree; ++d) {
    const int n_powers = monomials.size(std::min(d, monomials.degree()));
    for (; k < built_[cluster].counts[d]; ++k) {
      double sum = 0;
      for (int m = 0; m < n_powers; ++m) sum += coefficients(k, m) * powers[m];
      values[k] = sum;
    }
  }
}

NestedBasis ClusterPolynomials::make_basis(const std::vector<std::int8_t>& degrees) const {
  NestedBasis basis;
  basis.nodes.resize(tree_.clusters.size());
  std::vector<std::int8_t> needed = degrees;
  std::vector<std::int32_t> parent(degrees.size(), -1);
  std::uint64_t size = 0;
  for (std::size_t c = 0; c < degrees.size(); ++c) {
    const Cluster& its = tree_.clusters[c];
    NestedBasis::Node& node = basis.nodes[c];
    node.begin = static_cast<std::int32_t>(its.begin);
    node.end = static_cast<std::int32_t>(its.end);
    node.left = its.left;
    node.right = its.right;
    node.counts = built_[c].counts;
    node.area = built_[c].area;
    // The constants always: errors are told by them.
    node.used = node.counts[std::max<int>(needed[c], 0)];
    node.first = basis.n_functions;
    basis.n_functions += node.used;
    if (parent[c] >= 0) {
      node.transfer = size;
      size += std::uint64_t{basis.nodes[parent[c]].used} * node.used;
    }
    if (its.is_leaf()) {
      node.values = size;
      size += static_cast<std::uint64_t>(its.end - its.begin) * node.used;
      continue;
    }
    for (const std::int32_t child : {its.left, its.right}) {
      needed[child] = std::max(needed[child], needed[c]);
      parent[child] = static_cast<std::int32_t>(c);
    }
  }
  basis.numbers.resize(size);
  parallel_for(static_cast<std::ptrdiff_t>(basis.nodes.size()), [&](std::ptrdiff_t c) {
    const NestedBasis::Node& node = basis.nodes[c];
    float* values = &basis.numbers[node.values];
    if (node.is_leaf()) {
      for (Index row = 0; row < node.end - node.begin; ++row) {
        for (int k = 0; k < node.used; ++k) *values++ = built_[c].below(row, k);
      }
    }
    if (parent[c] < 0) return;
    const NestedBasis::Node& above = basis.nodes[parent[c]];
    const bool is_right = above.right == c;
    const Index first = is_right ? built_[above.left].counts.back() : 0;
    float* transfer = &basis.numbers[node.transfer];
    for (int k = 0; k < above.used; ++k) {
      for (int l = 0; l < node.used; ++l) *transfer++ = built_[parent[c]].below(first + l, k);
    }
  }, 256);
  return basis;
}

}  // namespace radiosity
