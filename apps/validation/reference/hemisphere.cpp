#include "apps/validation/reference/hemisphere.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "radiosity/base/parallel.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/solve/solution.h"

namespace apps::validation {
namespace {

using namespace radiosity;
using Random = std::mt19937_64;

/// A unit vector about `normal` with density cosθ / π.
Vec3 cosine_direction(const Vec3& normal, Random& random) {
  std::uniform_real_distribution<double> uniform(0, 1);
  const double azimuth = 2 * kPi * uniform(random);
  const double square = uniform(random);
  const Vec3 u = normal.unitOrthogonal();
  const Vec3 v = normal.cross(u);
  return std::sqrt(square) * (std::cos(azimuth) * u + std::sin(azimuth) * v) +
         std::sqrt(1 - square) * normal;
}

/// A uniform point of the patch: one of a quad's two triangles by area, then barycentric.
Vec3 random_point(const PatchMesh& mesh, Index i, Random& random) {
  std::uniform_real_distribution<double> uniform(0, 1);
  const Vec3& a = mesh.corner(i, 0);
  const auto double_area = [&](int c) {
    return (mesh.corner(i, c) - a).cross(mesh.corner(i, c + 1) - a).norm();
  };
  const bool is_second = mesh.n_corners(i) == 4 &&
                         uniform(random) * (double_area(1) + double_area(2)) > double_area(1);
  const int c = is_second ? 2 : 1;
  const double root = std::sqrt(uniform(random));
  const double v = uniform(random);
  return a + root * (1 - v) * (mesh.corner(i, c) - a) + root * v * (mesh.corner(i, c + 1) - a);
}

struct Moments {
  double mean = 0;
  double variance = 0;  ///< of one ray
};

Moments sample(const study::Study& assembly, const Eigen::VectorXd& radiosity, Index i, int n_rays,
               Random& random) {
  double sum = 0;
  double squares = 0;
  for (int k = 0; k < n_rays; ++k) {
    const Vec3 origin = random_point(assembly.mesh, i, random);
    const Vec3 direction = cosine_direction(assembly.mesh.normal[i], random);
    const auto hit = assembly.visibility.first_hit(origin, direction, static_cast<std::int32_t>(i));
    const double value = hit && hit->front ? radiosity[hit->patch] : 0;
    sum += value;
    squares += value * value;
  }
  const double mean = sum / n_rays;
  return {mean, squares / n_rays - mean * mean};
}

}  // namespace

std::vector<TwofoldIrradiance> compare_irradiance(const study::Study& assembly,
                                                  const Solution& solution,
                                                  const HemisphereOptions& options) {
  const Eigen::VectorXd radiosity = solution.radiosity.col(0);
  const Eigen::VectorXd irradiance = solution.irradiance.col(0);
  const Eigen::VectorXd area_error = assembly.transport->apply_error(radiosity);
  const Eigen::VectorXd mean_square = assembly.transport->apply(radiosity.cwiseAbs2());
  const Index n = (assembly.mesh.size() + options.stride - 1) / options.stride;
  std::vector<TwofoldIrradiance> list(n);
  parallel_for(n, [&](std::ptrdiff_t k) {
    const Index i = k * options.stride;
    std::seed_seq seed{options.seed, static_cast<std::uint64_t>(i)};
    Random random(seed);
    const Moments rays = sample(assembly, radiosity, i, options.n_rays, random);
    const double variance = std::max(rays.variance, mean_square[i] - std::pow(irradiance[i], 2));
    list[k] = {rays.mean, irradiance[i],
               std::hypot(std::sqrt(std::max(variance, 0.) / options.n_rays), area_error[i])};
  });
  return list;
}

}  // namespace apps::validation
