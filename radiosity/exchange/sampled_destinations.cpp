#include "radiosity/exchange/sampled_destinations.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <mutex>
#include <random>
#include <vector>

#include "radiosity/base/parallel.h"
#include "radiosity/scene/patch_mesh.h"

namespace radiosity {
namespace {

/// Means that are independent of each other, whose scatter tells the error.
constexpr Index kMeans = 16;

/// A point of a surface.
struct Element {
  Vec3 point;
  Vec3 normal;
};

/// Maps the unit square to points of equal density on a surface.
class SurfacePoints {
 public:
  SurfacePoints(const PatchMesh& mesh, std::int32_t surface) : mesh_(mesh) {
    double total = 0;
    for (Index i = 0; i < mesh.size(); ++i) {
      if (mesh.surface[i] != surface) continue;
      for (int k = 2; k < mesh.n_corners(i); ++k) {
        const Vec3& a = mesh.corner(i, 0);
        total += (mesh.corner(i, k - 1) - a).cross(mesh.corner(i, k) - a).norm();
        triangles_.push_back({i, k, total});
      }
    }
    assert(total > 0);
  }

  [[nodiscard]] Element element(double u, double v) const {
    const double place = u * triangles_.back().end;
    const auto triangle = std::upper_bound(
        triangles_.begin(), triangles_.end() - 1, place,
        [](double wanted, const Triangle& candidate) { return wanted < candidate.end; });
    const double begin = triangle == triangles_.begin() ? 0 : (triangle - 1)->end;
    const auto [patch, corner, end] = *triangle;
    const Vec3 point =
        triangle_point(mesh_.corner(patch, 0), mesh_.corner(patch, corner - 1),
                       mesh_.corner(patch, corner), (place - begin) / (end - begin), v);
    // Quads need not be planar to the last digit.
    const double height = mesh_.normal[patch].dot(point - mesh_.centroid[patch]);
    return {point - height * mesh_.normal[patch], mesh_.normal[patch]};
  }

 private:
  struct Triangle {
    Index patch;
    int corner;  // its last; the others are the one before and the patch's first
    double end;  // twice the area up to and with this one
  };
  const PatchMesh& mesh_;
  std::vector<Triangle> triangles_;
};

/// The additive recurrence with the generalised golden ratio of two dimensions (Roberts 2018), once
/// for each mean, shifted at random.
std::vector<Element> sample(const SurfacePoints& points, Index points_per_mean,
                            std::uint64_t seed) {
  constexpr double kStepU = 0.7548776662466927;
  constexpr double kStepV = 0.5698402909980532;
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform(0, 1);
  const auto wrap = [](double x) { return x - std::floor(x); };
  std::vector<Element> elements;
  for (Index mean = 0; mean < kMeans; ++mean) {
    const double u = uniform(random);
    const double v = uniform(random);
    for (Index k = 0; k < points_per_mean; ++k) {
      const auto step = static_cast<double>(k);
      elements.push_back(points.element(wrap(u + step * kStepU), wrap(v + step * kStepV)));
    }
  }
  return elements;
}

/// Shares as one column: surfaces, backs, sky.
Eigen::VectorXd column(const Destinations& shares) {
  Eigen::VectorXd values(shares.surfaces.size() + 2);
  values << shares.surfaces, shares.backs, shares.sky;
  return values;
}

Destinations destinations(const Eigen::VectorXd& values) {
  const Index n = values.size() - 2;
  return {values.head(n), values[n], values[n + 1]};
}

}  // namespace

DestinationEstimate sampled_destinations(const PatchMesh& mesh, std::int32_t surface,
                                         const SamplingOptions& options) {
  const Index points_per_mean = std::max<Index>(1, options.n_points / kMeans);
  const std::vector<Element> elements =
      sample(SurfacePoints(mesh, surface), points_per_mean, options.seed);
  const auto n_elements = static_cast<Index>(elements.size());
  Eigen::MatrixXd shares(static_cast<Index>(mesh.surface_names.size()) + 2, n_elements);
  std::mutex mutex;  // guards n_done
  Index n_done = 0;
  parallel_for(n_elements, [&](std::ptrdiff_t k) {
    shares.col(k) = column(
        point_factors(mesh, elements[k].point, elements[k].normal, {{}, options.progress.stop}));
    const std::lock_guard lock(mutex);
    ++n_done;
    if (options.progress.report) {
      options.progress.report("sky and backs", static_cast<double>(n_done),
                              static_cast<double>(n_elements), "points");
    }
  });
  Eigen::MatrixXd means(shares.rows(), kMeans);
  for (Index m = 0; m < kMeans; ++m) {
    means.col(m) = shares.middleCols(m * points_per_mean, points_per_mean).rowwise().mean();
  }
  const Eigen::VectorXd mean = means.rowwise().mean();
  const Eigen::VectorXd error = (means.colwise() - mean).rowwise().norm() /
                                std::sqrt(static_cast<double>(kMeans * (kMeans - 1)));
  return {destinations(mean), destinations(error)};
}

}  // namespace radiosity
