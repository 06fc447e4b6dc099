#include "radiosity/compressed/cluster_polynomials.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "radiosity/base/parallel.h"

namespace radiosity {
namespace {

/// Polynomials that are so small, next to the coordinates' size, once those before are taken out of
/// them, are no functions of their own.
constexpr double kSmallest = 0.03;
/// But what a parent's functions are made of is kept down to this share of them.
constexpr double kNeeded = 1e-3;
/// Clusters of more patches are built in parallel.
constexpr Index kSerial = 2048;

/// Makes functions orthonormal one by one; they are combinations of monomials whose inner products
/// are `gram`.
class Orthonormaliser {
 public:
  Orthonormaliser(const Eigen::MatrixXd& gram, Index most) : gram_(gram), most_(most) {
    rows_.resize(0, gram.rows());
  }

  /// What is left of a function without those before, and its norm.
  [[nodiscard]] std::pair<Eigen::RowVectorXd, double> remainder(Eigen::RowVectorXd function) const {
    // Twice, for what rounding leaves.
    for (int k = 0; k < 2; ++k) function -= (function * gram_ * rows_.transpose()) * rows_;
    return {function, std::sqrt(std::max(0.0, (function * gram_).dot(function)))};
  }

  /// Adds those of the functions that leave a remainder of at least `smallest`, largest first.
  void add(std::vector<Eigen::RowVectorXd> functions, double smallest) {
    while (!functions.empty() && rows_.rows() < most_) {
      std::size_t largest = 0;
      double norm = 0;
      for (std::size_t k = 0; k < functions.size(); ++k) {
        auto [left, size] = remainder(functions[k]);
        functions[k] = left;
        if (size > norm) {
          largest = k;
          norm = size;
        }
      }
      if (norm < smallest) return;
      rows_.conservativeResize(rows_.rows() + 1, Eigen::NoChange);
      rows_.bottomRows(1) = functions[largest] / norm;
      functions.erase(functions.begin() + static_cast<std::ptrdiff_t>(largest));
    }
  }

  [[nodiscard]] const Eigen::MatrixXd& rows() const { return rows_; }

 private:
  const Eigen::MatrixXd& gram_;
  Index most_;
  Eigen::MatrixXd rows_;
};

}  // namespace

ClusterPolynomials::ClusterPolynomials(const PatchMesh& mesh, const ClusterTree& tree)
    : mesh_(mesh), tree_(tree), planar_(2, kMostDegree), curved_(6, kMostCurvedDegree) {
  frames_.resize(tree.clusters.size());
  built_.resize(tree.clusters.size());
  if (!tree.clusters.empty()) build(0, -1);
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

void ClusterPolynomials::coordinates(const Frame& frame, std::int32_t patch, double* point) const {
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

Eigen::MatrixXd ClusterPolynomials::gram_matrix(std::int32_t cluster) const {
  const Cluster& its = tree_.clusters[cluster];
  const Frame& frame = frames_[cluster];
  const PolynomialSpace& monomials = space(frame);
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(monomials.size(), monomials.size());
  constexpr Index kAtOnce = 64;
  Eigen::MatrixXd values(monomials.size(), kAtOnce);
  std::array<double, 6> point{};
  double area = 0;
  for (Index begin = its.begin; begin < its.end; begin += kAtOnce) {
    const Index n = std::min(kAtOnce, its.end - begin);
    for (Index k = 0; k < n; ++k) {
      const std::int32_t patch = tree_.order[begin + k];
      coordinates(frame, patch, point.data());
      monomials.evaluate(point.data(), values.col(k).data());
      values.col(k) *= std::sqrt(mesh_.area[patch]);
      area += mesh_.area[patch];
    }
    gram.selfadjointView<Eigen::Lower>().rankUpdate(values.leftCols(n));
  }
  return Eigen::MatrixXd(gram.selfadjointView<Eigen::Lower>()) / area;
}

void ClusterPolynomials::build(std::int32_t cluster, std::int32_t parent) {
  const Cluster& its = tree_.clusters[cluster];
  const Frame* above = parent < 0 ? nullptr : &frames_[parent];
  frames_[cluster] = make_frame(cluster, above != nullptr && above->is_planar ? above : nullptr);
  const Frame& frame = frames_[cluster];
  const PolynomialSpace& monomials = space(frame);
  Built& built = built_[cluster];
  for (Index k = its.begin; k < its.end; ++k) built.area += mesh_.area[tree_.order[k]];

  Eigen::MatrixXd of_parent(0, monomials.size());
  if (above != nullptr) {
    const Eigen::MatrixXd substituted =
        space(*above).substituted(coordinate_map(*above, frame), monomials);
    of_parent = Eigen::MatrixXd::Zero(built_[parent].coefficients.rows(), monomials.size());
    of_parent.leftCols(substituted.cols()) =
        built_[parent].coefficients.cast<double>().leftCols(substituted.rows()) * substituted;
  }
  const Eigen::MatrixXd gram = gram_matrix(cluster);
  Orthonormaliser functions(gram, std::min<Index>({monomials.size(), its.end - its.begin, kMost}));
  for (int degree = 0; degree <= kMostDegree; ++degree) {
    if (degree <= monomials.degree()) {
      std::vector<Eigen::RowVectorXd> own;
      for (int m = degree > 0 ? monomials.size(degree - 1) : 0; m < monomials.size(degree); ++m) {
        own.push_back(Eigen::RowVectorXd::Unit(monomials.size(), m));
      }
      functions.add(std::move(own), kSmallest);
    }
    built.counts[degree] = static_cast<std::uint8_t>(functions.rows().rows());
  }
  // What vary less than makes a function, but are parts of the parent's, come last.
  std::vector<Eigen::RowVectorXd> needed;
  for (Index k = 0; k < of_parent.rows(); ++k) needed.emplace_back(of_parent.row(k));
  functions.add(std::move(needed), kNeeded);
  built.coefficients = functions.rows().cast<float>();
  built.transfer = (of_parent * gram * functions.rows().transpose()).cast<float>();

  if (its.is_leaf()) return;
  const std::array<std::int32_t, 2> children{its.left, its.right};
  const auto build_child = [&](std::ptrdiff_t k) { build(children[k], cluster); };
  if (its.end - its.begin > kSerial) {
    parallel_for(2, build_child);
  } else {
    build_child(0);
    build_child(1);
  }
}

void ClusterPolynomials::evaluate(std::int32_t cluster, std::int32_t patch, int degree,
                                  double* values) const {
  evaluate_first(cluster, patch, built_[cluster].counts[degree], values);
}

void ClusterPolynomials::evaluate_first(std::int32_t cluster, std::int32_t patch, int n,
                                        double* values) const {
  const Frame& frame = frames_[cluster];
  const PolynomialSpace& monomials = space(frame);
  std::array<double, 6> point{};
  std::array<double, kMost> powers{};
  coordinates(frame, patch, point.data());
  monomials.evaluate(point.data(), powers.data());
  const Built& built = built_[cluster];
  int degree = 0;
  for (int k = 0; k < n; ++k) {
    while (degree < monomials.degree() && k >= built.counts[degree]) ++degree;
    double sum = 0;
    for (int m = 0; m < monomials.size(degree); ++m) sum += built.coefficients(k, m) * powers[m];
    values[k] = sum;
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
    const auto n_all = static_cast<std::uint8_t>(built_[c].coefficients.rows());
    node.used = needed[c] > kMostDegree ? n_all : node.counts[std::max<int>(needed[c], 0)];
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
      // Polynomials in a plane are of the same degree below; others may take all there are.
      const bool is_planar = frames_[c].is_planar || needed[c] <= 0;
      needed[child] = std::max<std::int8_t>(needed[child], is_planar ? needed[c] : kMostDegree + 1);
      parent[child] = static_cast<std::int32_t>(c);
    }
  }
  basis.numbers.resize(size);
  parallel_for(
      static_cast<std::ptrdiff_t>(basis.nodes.size()),
      [&](std::ptrdiff_t c) {
        const NestedBasis::Node& node = basis.nodes[c];
        if (node.is_leaf()) {
          std::array<double, kMost> values{};
          float* value = basis.numbers.data() + node.values;
          for (std::int32_t row = node.begin; row < node.end; ++row) {
            evaluate_first(static_cast<std::int32_t>(c), tree_.order[row], node.used,
                           values.data());
            for (int k = 0; k < node.used; ++k) *value++ = static_cast<float>(values[k]);
          }
        }
        if (parent[c] < 0) return;
        float* transfer = basis.numbers.data() + node.transfer;
        for (int k = 0; k < basis.nodes[parent[c]].used; ++k) {
          for (int l = 0; l < node.used; ++l) *transfer++ = built_[c].transfer(k, l);
        }
      },
      256);
  return basis;
}

}  // namespace radiosity
