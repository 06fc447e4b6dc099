#include "radiosity/visibility/patch_contact.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace radiosity {
namespace {

/// Planes at a larger angle, by its sine, are not parallel, however slender their patches are.
constexpr double kMostParallel = 0.1;

struct ContactInterval {
  double low;
  double high;
};

}  // namespace

const Vec3& PatchContact::corner(std::int32_t patch, int k) const {
  const int n = mesh_.n_corners(patch);
  return mesh_.corner(patch, k < n ? k : k - n);
}

Vec3 PatchContact::inwards(std::int32_t patch, int edge) const {
  const Vec3 along = corner(patch, edge + 1) - corner(patch, edge);
  return mesh_.normal[patch].cross(along).normalized();
}

PatchContact::Inwards PatchContact::all_inwards(std::int32_t patch) const {
  Inwards result;
  for (int k = 0; k < mesh_.n_corners(patch); ++k) result[k] = inwards(patch, k);
  return result;
}

/// Across a patch, its longest edge along it.
double PatchContact::width(std::int32_t patch) const {
  double longest2 = 0;
  for (int k = 0; k < mesh_.n_corners(patch); ++k) {
    longest2 = std::max(longest2, (corner(patch, k + 1) - corner(patch, k)).squaredNorm());
  }
  return mesh_.area[patch] / std::sqrt(longest2);
}

/// Sine of the angle between planes that may be parallel.
double PatchContact::parallel_sine(std::int32_t i, std::int32_t j) const {
  return kParallel + reach_ / std::min(width(i), width(j));
}

Contact PatchContact::between(std::int32_t i, std::int32_t j, const Inwards& inwards_i) const {
  const Vec3 along = mesh_.normal[i].cross(mesh_.normal[j]);
  const double sine = along.norm();
  if (sine <= kMostParallel && sine <= parallel_sine(i, j)) {
    return between_parallel(i, j, inwards_i);
  }
  const auto segment = meeting(i, j, along);
  if (!segment) return Contact::none;
  const double margin = reach_ * (1 + 1 / sine);
  if (is_along_edge(i, *segment, margin) && is_along_edge(j, *segment, margin)) {
    return Contact::none;
  }
  return stands_on(i, j, *segment, 2 * margin) || stands_on(j, i, *segment, 2 * margin)
             ? Contact::stands
             : Contact::crosses;
}

/// Whether a segment of both lies along an edge of `patch` that is in the other wherever the
/// segment is.
bool PatchContact::stands_on(std::int32_t patch, std::int32_t other,
                             const std::array<Vec3, 2>& segment, double margin) const {
  for (int k = 0; k < mesh_.n_corners(patch); ++k) {
    const Vec3& a = corner(patch, k);
    const Vec3& b = corner(patch, k + 1);
    const auto part = part_within(a, b, other);
    if (!part) continue;
    const Vec3 u = (b - a).normalized();
    const auto holds = [&](const Vec3& x) {
      const double t = u.dot(x - a);
      return (x - a - t * u).norm() <= margin && t >= part->low - margin &&
             t <= part->high + margin;
    };
    if (holds(segment[0]) && holds(segment[1])) return true;
  }
  return false;
}

std::optional<PatchContact::Part> PatchContact::part_within(const Vec3& start, const Vec3& end,
                                                            std::int32_t patch) const {
  const Vec3& normal = mesh_.normal[patch];
  const double first = normal.dot(start - mesh_.centroid[patch]);
  const double last = normal.dot(end - mesh_.centroid[patch]);
  if (std::min(first, last) > reach_ || std::max(first, last) < -reach_) return std::nullopt;
  double low = 0;
  double high = 1;
  for (int k = 0; k < mesh_.n_corners(patch); ++k) {
    const Vec3 in = inwards(patch, k);
    const double a = in.dot(start - corner(patch, k));
    const double b = in.dot(end - corner(patch, k));
    if (std::max(a, b) <= 0) return std::nullopt;
    if (a < 0) low = std::max(low, a / (a - b));
    if (b < 0) high = std::min(high, a / (a - b));
  }
  const double length = (end - start).norm();
  if ((high - low) * length <= 2 * reach_) return std::nullopt;
  const auto is_on = [&](double t) { return std::abs(first + t * (last - first)) <= reach_; };
  if (!is_on(low) || !is_on(high)) return std::nullopt;
  return Part{low * length, high * length};
}

/// Whether an edge of one of two nearly parallel patches has the other on its outer side.
bool PatchContact::are_beside(std::int32_t i, std::int32_t j, const Inwards& inwards_i) const {
  const Vec3& normal = mesh_.normal[i];
  const auto flat = [&](const Vec3& x) {
    return Vec3(x - normal.dot(x - mesh_.centroid[i]) * normal);
  };
  for (const auto& [a, b] : {std::pair(i, j), std::pair(j, i)}) {
    for (int k = 0; k < mesh_.n_corners(a); ++k) {
      const Vec3 in = a == i ? inwards_i[k] : inwards(a, k);
      double most = -std::numeric_limits<double>::infinity();
      for (int m = 0; m < mesh_.n_corners(b); ++m) {
        most = std::max(most, in.dot(flat(corner(b, m)) - corner(a, k)));
      }
      if (most <= reach_) return true;
    }
  }
  return false;
}

/// The part of patch j over patch i, off the edges of that by the reach.
ConvexPolygon PatchContact::common_part(std::int32_t i, std::int32_t j) const {
  ConvexPolygon part;
  for (int m = 0; m < mesh_.n_corners(j); ++m) part.push_back(corner(j, m));
  for (int k = 0; k < mesh_.n_corners(i) && !part.empty(); ++k) {
    const Vec3 in = inwards(i, k);
    keep_above(corner(i, k) + reach_ * in, in, part);
  }
  return part;
}

Contact PatchContact::between_parallel(std::int32_t i, std::int32_t j,
                                       const Inwards& inwards_i) const {
  if (are_beside(i, j, inwards_i)) return Contact::none;
  // The plane of a small patch is not known far from it: what counts is how far they are apart
  // where they lie on each other.
  const auto height = heights_over(i, j);
  if (!height || height->low > reach_ || height->high < -reach_) return Contact::none;
  if (height->low >= -reach_ && height->high <= reach_) return Contact::overlaps;
  const bool is_through = height->low < -reach_ / 2 && height->high > reach_ / 2;
  return is_through ? Contact::crosses : Contact::leans;
}

std::optional<PatchContact::Part> PatchContact::heights_over(std::int32_t i, std::int32_t j) const {
  const ConvexPolygon part = common_part(i, j);
  if (part.size() < 3) return std::nullopt;
  Part heights{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const Vec3& x : part) {
    const double height = mesh_.normal[i].dot(x - mesh_.centroid[i]);
    heights.low = std::min(heights.low, height);
    heights.high = std::max(heights.high, height);
  }
  return heights;
}

/// The segment in which two patches meet whose planes do, if it is longer than `reach_`.
std::optional<std::array<Vec3, 2>> PatchContact::meeting(std::int32_t i, std::int32_t j,
                                                         const Vec3& along) const {
  const Vec3 u = along.normalized();
  std::optional<ContactInterval> common;
  for (const auto& [a, b] : {std::pair(i, j), std::pair(j, i)}) {
    const Vec3& normal = mesh_.normal[a];
    std::optional<ContactInterval> here;
    const auto add = [&](const Vec3& point) {
      const double t = u.dot(point - mesh_.centroid[i]);
      if (!here) here = {t, t};
      here->low = std::min(here->low, t);
      here->high = std::max(here->high, t);
    };
    for (int k = 0; k < mesh_.n_corners(b); ++k) {
      const double first = normal.dot(corner(b, k) - mesh_.centroid[a]);
      const double last = normal.dot(corner(b, k + 1) - mesh_.centroid[a]);
      if (std::abs(first) <= reach_) {
        add(corner(b, k));
      } else if (std::abs(last) > reach_ && first * last < 0) {
        add(corner(b, k) + first / (first - last) * (corner(b, k + 1) - corner(b, k)));
      }
    }
    if (!here) return std::nullopt;
    if (!common) {
      common = here;
    } else {
      common->low = std::max(common->low, here->low);
      common->high = std::min(common->high, here->high);
    }
  }
  if (common->high - common->low <= reach_) return std::nullopt;
  // A point of both planes.
  const Vec3& n = mesh_.normal[i];
  const Vec3& m = mesh_.normal[j];
  const double c = n.dot(m);
  const double height = m.dot(mesh_.centroid[i] - mesh_.centroid[j]);
  const Vec3 foot = mesh_.centroid[i] - height / (1 - c * c) * (m - c * n);
  return std::array<Vec3, 2>{foot + common->low * u, foot + common->high * u};
}

bool PatchContact::is_along_edge(std::int32_t patch, const std::array<Vec3, 2>& segment,
                                 double margin) const {
  const auto corner_of = [&](int k) -> const Vec3& { return mesh_.corner(patch, k); };
  return radiosity::is_along_edge(segment[0], segment[1], mesh_.n_corners(patch), corner_of,
                                  margin);
}

}  // namespace radiosity
