#include "radiosity/exchange/openings.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "radiosity/base/parallel.h"
#include "radiosity/exchange/visible_fraction.h"
#include "radiosity/visibility/coverage.h"

namespace radiosity {
namespace {

constexpr double kRaysInAll = 2e5;
constexpr double kFewestRaysOfPatch = 16;
constexpr double kMostRaysOfPatch = 1024;
constexpr double kRaysOfRows = 2e6;
constexpr double kFewestRaysOfRow = 64;
constexpr double kLeastMissing = 1e-4;
/// Of patches narrower than so many gaps, in which rays meet nothing at their start, too many pass
/// by what stands beside them.
constexpr double kLeastGapsAcross = 256;

struct Count {
  std::int64_t backs = 0;
  std::int64_t sky = 0;
};

double width(const PatchMesh& mesh, std::int32_t patch) {
  double longest = 0;
  for (int k = 0; k < mesh.n_corners(patch); ++k) {
    const Vec3& next = mesh.corner(patch, (k + 1) % mesh.n_corners(patch));
    longest = std::max(longest, (next - mesh.corner(patch, k)).norm());
  }
  return mesh.area[patch] / longest;
}

Vec3 random_point(const PatchMesh& mesh, std::int32_t patch, double choice, double u, double v) {
  const Vec3& a = mesh.corner(patch, 0);
  const Vec3& c = mesh.corner(patch, 2);
  const Vec3& b = mesh.corner(patch, 1);
  const bool is_second =
      mesh.n_corners(patch) == 4 && choice * mesh.area[patch] > 0.5 * (b - a).cross(c - a).norm();
  const Vec3& p = is_second ? c : b;
  const Vec3& q = is_second ? mesh.corner(patch, 3) : c;
  return triangle_point(a, p, q, u, v);
}

Count count_rays(const PatchMesh& mesh, const Visibility& visibility, std::int32_t patch,
                 int n_rays, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto uniform = [&random] { return static_cast<double>(random() >> 11U) * 0x1p-53; };
  const Vec3& normal = mesh.normal[patch];
  const Vec3 u = normal.unitOrthogonal();
  const Vec3 v = normal.cross(u);
  Count count;
  for (int k = 0; k < n_rays; ++k) {
    const double choice = uniform();
    const double s = uniform();
    const double t = uniform();
    const Vec3 origin = random_point(mesh, patch, choice, s, t);
    const double azimuth = 2 * kPi * uniform();
    const double square = uniform();
    const Vec3 direction = std::sqrt(square) * (std::cos(azimuth) * u + std::sin(azimuth) * v) +
                           std::sqrt(1 - square) * normal;
    const std::optional<Hit> hit = visibility.first_hit(origin, direction, patch);
    count.sky += hit ? 0 : 1;
    count.backs += hit && !hit->front ? 1 : 0;
  }
  return count;
}

}  // namespace

Eigen::VectorXd shares_on_backs(const PatchMesh& mesh, const Visibility& visibility,
                                const Eigen::VectorXd& missing, std::uint64_t seed) {
  std::vector<std::int32_t> asked;
  for (std::int32_t i = 0; i < mesh.size(); ++i) {
    if (missing[i] >= kLeastMissing) asked.push_back(i);
  }
  Eigen::VectorXd result = Eigen::VectorXd::Zero(mesh.size());
  if (asked.empty()) return result;
  const auto n_rays = static_cast<int>(std::clamp(kRaysInAll / static_cast<double>(asked.size()),
                                                  kFewestRaysOfPatch, kMostRaysOfPatch));
  std::vector<Count> counts(asked.size());
  parallel_for(static_cast<std::ptrdiff_t>(asked.size()), [&](std::ptrdiff_t k) {
    counts[k] = count_rays(mesh, visibility, asked[k], n_rays, pair_seed(seed, asked[k], -1));
  });
  Count all;
  for (const Count& count : counts) {
    all.backs += count.backs;
    all.sky += count.sky;
  }
  if (all.backs == 0) return result;
  if (all.sky == 0) return missing;
  for (std::size_t k = 0; k < asked.size(); ++k) {
    const Count& count = counts[k].backs + counts[k].sky > 0 ? counts[k] : all;
    result[asked[k]] = missing[asked[k]] * static_cast<double>(count.backs) /
                       static_cast<double>(count.backs + count.sky);
  }
  return result;
}

std::vector<OpenShare> open_shares(const PatchMesh& mesh, const Visibility& visibility,
                                   const Eigen::VectorXd& covered,
                                   const std::vector<std::int32_t>& patches, std::uint64_t seed) {
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  std::vector<OpenShare> result(patches.size(), {kUnknown, kUnknown});
  const auto n_rays = static_cast<int>(std::clamp(
      kRaysOfRows / static_cast<double>(patches.size() + 1), kFewestRaysOfRow, kMostRaysOfPatch));
  const double least_width = kLeastGapsAcross * visibility.end_gap();
  parallel_for(static_cast<std::ptrdiff_t>(patches.size()), [&](std::ptrdiff_t k) {
    const std::int32_t patch = patches[k];
    if (covered[patch] > 0 || width(mesh, patch) < least_width) return;
    const Count count = count_rays(mesh, visibility, patch, n_rays, pair_seed(seed, patch, -2));
    const double share = static_cast<double>(count.backs + count.sky) / n_rays;
    // Of none and of all, what one ray more might have told.
    result[k] = {share, std::max(std::sqrt(share * (1 - share) / n_rays), 1. / n_rays)};
  });
  return result;
}

bool is_enclosed(const PatchMesh& mesh, const Visibility& visibility, double tolerance,
                 std::uint64_t seed) {
  const Coverage coverage = find_coverage(mesh, plane_thickness(mesh));
  const double least_width = kLeastGapsAcross * visibility.end_gap();
  std::vector<std::int32_t> asked;
  const auto step = static_cast<Index>(
      std::ceil(static_cast<double>(mesh.size()) * kFewestRaysOfPatch / kRaysInAll));
  for (Index i = 0; i < mesh.size(); i += step) {
    const auto patch = static_cast<std::int32_t>(i);
    // What is covered in part has rays that start in the dark.
    if (coverage.share[i] == 0 && width(mesh, patch) >= least_width) asked.push_back(patch);
  }
  if (asked.empty()) return false;
  const int n_rays = static_cast<int>(std::clamp(kRaysInAll / static_cast<double>(asked.size()),
                                                 kFewestRaysOfPatch, kMostRaysOfPatch));
  // So many may miss by chance where `tolerance` of them does in the mean.
  constexpr double kSigmas = 3;
  const double expected = tolerance * n_rays;
  const double most = expected + kSigmas * std::sqrt(expected) + 1;
  std::vector<char> is_open(asked.size(), 0);
  parallel_for(static_cast<std::ptrdiff_t>(asked.size()), [&](std::ptrdiff_t k) {
    const Count count =
        count_rays(mesh, visibility, asked[k], n_rays, pair_seed(seed, asked[k], -1));
    is_open[k] = static_cast<double>(count.backs + count.sky) > most ? 1 : 0;
  });
  return std::find(is_open.begin(), is_open.end(), 1) == is_open.end();
}

}  // namespace radiosity
