#include "radiosity/visibility/patch_contact.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace radiosity {
namespace {

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

/// Sine of the angle between planes that may be parallel.
double PatchContact::parallel_sine(std::int32_t i, std::int32_t j) const {
  return kParallel + reach_ / std::sqrt(std::min(mesh_.area[i], mesh_.area[j]));
}

bool PatchContact::cross_or_cover(std::int32_t i, std::int32_t j, const Inwards& inwards_i) const {
  const Vec3 along = mesh_.normal[i].cross(mesh_.normal[j]);
  const double sine = along.norm();
  if (sine <= parallel_sine(i, j)) return overlap(i, j, inwards_i);
  const auto segment = meeting(i, j, along);
  if (!segment) return false;
  const double margin = reach_ * (1 + 1 / sine);
  return !is_along_edge(i, *segment, margin) || !is_along_edge(j, *segment, margin);
}

/// Whether some of patch j lies on patch i, off its edges, given that they are parallel.
bool PatchContact::overlap(std::int32_t i, std::int32_t j, const Inwards& inwards_i) const {
  const Vec3& normal = mesh_.normal[i];
  const auto flat = [&](const Vec3& x) {
    return Vec3(x - normal.dot(x - mesh_.centroid[i]) * normal);
  };
  // Separated by an edge of one of them, or by distance.
  double nearest = std::numeric_limits<double>::infinity();
  for (int k = 0; k < mesh_.n_corners(j); ++k) {
    nearest = std::min(nearest, std::abs(normal.dot(corner(j, k) - mesh_.centroid[i])));
  }
  if (nearest > reach_) return false;
  for (const auto& [a, b] : {std::pair(i, j), std::pair(j, i)}) {
    for (int k = 0; k < mesh_.n_corners(a); ++k) {
      const Vec3 in = a == i ? inwards_i[k] : inwards(a, k);
      double most = -std::numeric_limits<double>::infinity();
      for (int m = 0; m < mesh_.n_corners(b); ++m) {
        most = std::max(most, in.dot(flat(corner(b, m)) - corner(a, k)));
      }
      if (most <= reach_) return false;
    }
  }
  return true;
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
