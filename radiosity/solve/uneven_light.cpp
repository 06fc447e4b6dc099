#include "radiosity/solve/uneven_light.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include "radiosity/base/parallel.h"
#include "radiosity/solve/solution_error.h"

namespace radiosity {
namespace {

/// The exchange varies by no more than this: from nothing to twice its mean.
constexpr double kLargestVariation = 2;
/// Solutions with random signs.
constexpr Index kLightProbes = 4;
constexpr std::uint64_t kLightSeed = 1;
constexpr Index kBlock = 16;  // rows worked on together, which stay in the cache

/// Places and sizes of patches.
struct Places {
  Eigen::ArrayXd x, y, z;  ///< of the centroids, m
  Eigen::ArrayXd size;     ///< √A, m
};

Places make_places(const PatchMesh& mesh) {
  const Eigen::ArrayXd zero = Eigen::ArrayXd::Zero(mesh.size());
  Places places{zero, zero, zero, zero};
  for (Index i = 0; i < mesh.size(); ++i) {
    places.x[i] = mesh.centroid[i].x();
    places.y[i] = mesh.centroid[i].y();
    places.z[i] = mesh.centroid[i].z();
    places.size[i] = std::sqrt(mesh.area[i]);
  }
  return places;
}

/// Rows of F and the distances of their patches from all others, transposed: a column per row.
struct Rows {
  Index first;
  Eigen::ArrayXXd factors;
  Eigen::ArrayXXd distance;
};

/// Calls work(rows) for all blocks of rows, or for this rank's share, whose results `complete` then
/// fills up.
template <typename Work>
void for_rows(const Transport& transport, const Places& places, const Progress& progress,
              const Work& work) {
  const Index n = transport.size();
  const auto with_distances = [&](Index first, Eigen::ArrayXXd factors) {
    Rows rows{first, std::move(factors), {}};
    rows.distance.resize(n, rows.factors.cols());
    for (Index i = 0; i < rows.factors.cols(); ++i) {
      rows.distance.col(i) = (places.x - places.x[first + i]).square() +
                             (places.y - places.y[first + i]).square() +
                             (places.z - places.z[first + i]).square();
    }
    rows.distance = rows.distance.sqrt();
    work(rows);
  };
  if (const SharedRows* shared = transport.shared_rows()) {
    return shared->visit_share(kBlock, progress, [&](Index first, const Eigen::MatrixXd& rows) {
      with_distances(first, rows.array());
    });
  }
  parallel_for((n + kBlock - 1) / kBlock, [&](Index block) {
    progress.check();
    const Index first = block * kBlock;
    const Index size = std::min(kBlock, n - first);
    Eigen::ArrayXXd factors(n, size);
    for (Index i = 0; i < size; ++i) {
      factors.col(i) = rows_of(transport).row(first + i).array();
    }
    with_distances(first, std::move(factors));
  });
}

/// What other ranks have made of their rows.
void complete(const Transport& transport, Eigen::MatrixXd& values) {
  if (const SharedRows* shared = transport.shared_rows()) shared->complete(kBlock, values);
}

/// How light varies over each patch.
struct Variation {
  Eigen::ArrayXd exchange;  ///< Σ_k F_jk v_jk, n
  Eigen::MatrixXd light;    ///< D_j, W/m², n x k
};

Variation find_variation(const Transport& transport, const Places& places, const Solution& solution,
                         const Progress& progress) {
  const Index n = transport.size();
  const Index k = solution.radiosity.cols();
  const Index n_bands = solution.reflectance.cols();
  const Eigen::MatrixXd received = solution.exchanged_irradiance();
  // (B_k - H_j)² is multiplied out; about the mean it keeps its digits.
  const Eigen::RowVectorXd mean = received.colwise().mean();
  const Eigen::MatrixXd b = solution.radiosity.rowwise() - mean;
  const Eigen::MatrixXd b_squared = b.cwiseAbs2();
  Variation variation{Eigen::ArrayXd(n), Eigen::MatrixXd(n, k)};
  Eigen::MatrixXd exchange(n, 1);
  for_rows(transport, places, progress, [&](const Rows& rows) {
    const Index size = rows.factors.cols();
    Eigen::ArrayXXd varying = rows.factors;
    for (Index j = 0; j < size; ++j) {
      varying.col(j) *= (places.size[rows.first + j] / rows.distance.col(j)).min(kLargestVariation);
    }
    exchange.col(0).segment(rows.first, size) = varying.colwise().sum();
    const Eigen::MatrixXd weight = varying.square().matrix();
    const Eigen::ArrayXd sum = weight.colwise().sum();
    const Eigen::MatrixXd first_moment = weight.transpose() * b;
    const Eigen::MatrixXd second_moment = weight.transpose() * b_squared;
    for (Index c = 0; c < k; ++c) {
      const Eigen::ArrayXd h = received.col(c).segment(rows.first, size).array() - mean[c];
      const Eigen::ArrayXd square =
          second_moment.col(c).array() - 2 * h * first_moment.col(c).array() + h.square() * sum;
      variation.light.col(c).segment(rows.first, size) =
          solution.reflectance.col(c % n_bands).segment(rows.first, size).array() *
          square.max(0).sqrt();
    }
  });
  complete(transport, exchange);
  complete(transport, variation.light);
  variation.exchange = exchange.col(0).array();
  return variation;
}

/// v_jk of a patch of some size.
double variation_of(double size, double distance) {
  return std::min(size / distance, kLargestVariation);
}

Variation find_variation(const PatchMesh& mesh, const Transport& transport, const PairSums& pairs,
                         const Solution& solution) {
  const Eigen::VectorXd& area = transport.area();
  const Index k = solution.radiosity.cols();
  const Eigen::MatrixXd received = solution.exchanged_irradiance();
  const Eigen::RowVectorXd mean = received.colwise().mean();
  const Eigen::MatrixXd b = solution.radiosity.rowwise() - mean;
  const Eigen::MatrixXd h = received.rowwise() - mean;
  Variation variation;
  variation.exchange = pairs.sums(mesh, area, [](const ExchangingPair& pair) {
    return pair.density * variation_of(pair.size, pair.distance);
  });
  Eigen::MatrixXd powers(b.rows(), 1 + 2 * k);
  powers << Eigen::VectorXd::Ones(b.rows()), b, b.cwiseAbs2();
  powers.array().colwise() *= area.array().square();
  const Eigen::MatrixXd moments = pairs.sums(mesh, powers, [](const ExchangingPair& pair) {
    return square(pair.density * variation_of(pair.size, pair.distance));
  });
  const Eigen::MatrixXd squares =
      moments.rightCols(k) - 2 * h.cwiseProduct(moments.middleCols(1, k)) +
      Eigen::MatrixXd(h.array().square().colwise() * moments.col(0).array());
  variation.light = squares.cwiseMax(0).cwiseSqrt();
  for (Index c = 0; c < k; ++c) {
    variation.light.col(c).array() *=
        solution.reflectance.col(c % solution.reflectance.cols()).array();
  }
  return variation;
}

/// What is received wrongly.
struct Received {
  Eigen::MatrixXd local;   ///< s_i, W/m², n x k
  Eigen::MatrixXd probes;  ///< the same with random signs, n x (k kLightProbes)
};

/// D_j with a random sign in each of `kLightProbes` times k columns, which the patches of a group
/// share.
Eigen::MatrixXd with_random_signs(const NeighborGroups& groups, const Eigen::MatrixXd& light) {
  std::mt19937_64 random(kLightSeed);
  std::vector<std::uint64_t> bits(groups.n_groups);
  for (std::uint64_t& word : bits) word = random();
  Eigen::MatrixXd result = light.replicate(1, kLightProbes);
  parallel_segments(result.rows(), [&](Index begin, Index n) {
    for (Index column = 0; column < result.cols(); ++column) {
      for (Index i = begin; i < begin + n; ++i) {
        const std::uint64_t bit = bits[groups.group_of[i]] >> (column / light.cols()) & 1;
        if (bit != 0) result(i, column) *= -1;
      }
    }
  });
  return result;
}

Received receive(const Transport& transport, const Places& places, const Variation& variation,
                 const NeighborGroups& groups, const Progress& progress) {
  const Index n = transport.size();
  const Index k = variation.light.cols();
  const Eigen::MatrixXd squared_light = variation.light.cwiseAbs2();
  const Eigen::MatrixXd signed_light = with_random_signs(groups, variation.light);
  Received received{Eigen::MatrixXd(n, k), Eigen::MatrixXd(n, k * kLightProbes)};
  for_rows(transport, places, progress, [&](const Rows& rows) {
    const Index size = rows.factors.cols();
    Eigen::MatrixXd weight(n, size);
    for (Index i = 0; i < size; ++i) {
      weight.col(i) =
          rows.factors.col(i) *
          ((places.size / rows.distance.col(i)).min(kLargestVariation) - variation.exchange);
    }
    received.probes.middleRows(rows.first, size) = weight.transpose() * signed_light;
    received.local.middleRows(rows.first, size) =
        (weight.cwiseAbs2().transpose() * squared_light).cwiseSqrt();
  });
  complete(transport, received.probes);
  complete(transport, received.local);
  return received;
}

Received receive(const PatchMesh& mesh, const Transport& transport, const PairSums& pairs,
                 const Variation& variation, const NeighborGroups& groups) {
  const Eigen::ArrayXd& exchange = variation.exchange;
  const Eigen::ArrayXd area = transport.area().array();
  const auto scaled = [](const Eigen::MatrixXd& x, const Eigen::ArrayXd& factors) {
    return Eigen::MatrixXd(x.array().colwise() * factors);
  };
  // Σ_j κ^p A_j^p x_j, with p = 1 or 2, by the power q of v_ji.
  const auto sums = [&](const Eigen::MatrixXd& x, int p, int q) {
    return pairs.sums(mesh, scaled(x, area.pow(p)), [p, q](const ExchangingPair& pair) {
      const double varying = q > 0 ? variation_of(pair.other_size, pair.distance) : 1;
      return (p > 1 ? square(pair.density) : pair.density) * (q > 1 ? square(varying) : varying);
    });
  };
  const Eigen::MatrixXd signed_light = with_random_signs(groups, variation.light);
  const Eigen::MatrixXd squared_light = variation.light.cwiseAbs2();
  Received received;
  received.probes = sums(signed_light, 1, 1) - sums(scaled(signed_light, exchange), 1, 0);
  received.local = sums(squared_light, 2, 2) - 2 * sums(scaled(squared_light, exchange), 2, 1) +
                   sums(scaled(squared_light, exchange.square()), 2, 0);
  received.local = received.local.cwiseMax(0).cwiseSqrt();
  return received;
}

Received received_wrongly(const PatchMesh& mesh, const Transport& transport,
                          const Solution& solution, const NeighborGroups& groups,
                          const Progress& progress) {
  if (const PairSums* pairs = transport.pair_sums()) {
    progress.check();
    const Variation variation = find_variation(mesh, transport, *pairs, solution);
    progress.check();
    return receive(mesh, transport, *pairs, variation, groups);
  }
  const Places places = make_places(mesh);
  const Variation variation = find_variation(transport, places, solution, progress);
  return receive(transport, places, variation, groups, progress);
}

}  // namespace

Eigen::MatrixXd uneven_light_error(const PatchMesh& mesh, const Transport& transport,
                                   const Solution& solution, const NeighborGroups& groups,
                                   const Progress& progress) {
  Received received = received_wrongly(mesh, transport, solution, groups, progress);
  const Index n_bands = solution.reflectance.cols();
  for (Index c = 0; c < received.probes.cols(); ++c) {
    received.probes.col(c).array() *= solution.reflectance.col(c % n_bands).array();
  }
  for (Index c = 0; c < received.local.cols(); ++c) {
    received.local.col(c).array() *= solution.reflectance.col(c % n_bands).array();
  }
  const Eigen::MatrixXd reflected =
      reflected_light(transport, solution, std::move(received.probes), progress);
  Eigen::MatrixXd variance = received.local.cwiseAbs2();
  const Index k = variance.cols();
  for (Index c = 0; c < reflected.cols(); ++c) {
    variance.col(c % k) += reflected.col(c).cwiseAbs2() / kLightProbes;
  }
  return variance.cwiseSqrt();
}

}  // namespace radiosity
