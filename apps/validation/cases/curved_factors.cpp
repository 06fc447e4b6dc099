#include "apps/validation/cases/curved_factors.h"
#include "apps/validation/cases/asked.h"

#include <fmt/format.h>

#include <cmath>
#include <functional>

#include "apps/validation/reference/built_scenes.h"
#include "radiosity/polygon/exchange_area.h"

namespace apps::validation {
namespace {

using namespace radiosity;

using Facets = std::vector<Polygon>;

/// Facets of a shape; `n`, a power of two and at least 8, go round it.
using Shape = std::function<Facets(int n)>;

constexpr int kCoarsest = 8;

/// F from one set of facets to another.
double factor(const Facets& from, const Facets& to) {
  double exchange = 0;
  double area = 0;
  for (const Polygon& a : from) {
    area += vector_area(a).norm();
    for (const Polygon& b : to) {
      if (a != b) exchange += exchange_area(a, b);
    }
  }
  return exchange / area;
}

/// F of the round shapes, by Richardson's extrapolation of errors in h², h⁴, ...
FactorComparison compare(const KnownFactor& known, const std::string& key, const Shape& from,
                         const Shape& to) {
  double values[3];
  for (int k = 0; k < 3; ++k) {
    const int n = kCoarsest << k;
    values[k] = factor(from(n), to(n));
  }
  const double before = (4 * values[1] - values[0]) / 3;
  const double extrapolated = (4 * values[2] - values[1]) / 3;
  const double expected = known.value(key);
  return {fmt::format("{}: {}", known.name, key), FactorKind::curved, extrapolated, expected,
          std::abs(extrapolated - before) / expected + kAskedOfFactors};
}

Shape disk(double radius, double z, bool faces_up) {
  return [=](int n) { return Facets{regular_polygon(n, radius, z, faces_up)}; };
}

/// The wall of a cylinder seen from inside, from z = 0 to h.
Shape cylinder_wall(double radius, double height) {
  return [=](int n) {
    Facets faces = prism_inside(regular_polygon(n, radius, 0, true), height);
    faces.erase(faces.begin(), faces.begin() + 2);
    return faces;
  };
}

/// A cone of base radius 1 at z = 0 seen from inside.
Shape cone(double half_angle) {
  return [=](int n) {
    const Polygon base = regular_polygon(n, 1, 0, true);
    const Vec3 apex(0, 0, 1 / std::tan(half_angle));
    Facets faces;
    for (int k = 0; k < n; ++k) faces.push_back({base[(k + 1) % n], base[k], apex});
    return faces;
  };
}

/// The upper unit hemisphere seen from inside, in rings of trapezoids.
Facets hemisphere(int n) {
  const int n_rings = n / 4;
  const auto point = [&](int ring, int k) {
    const double height = 0.5 * kPi * ring / n_rings;
    const double azimuth = 2 * kPi * k / n;
    return Vec3(std::cos(height) * std::cos(azimuth), std::cos(height) * std::sin(azimuth),
                std::sin(height));
  };
  Facets faces;
  for (int ring = 0; ring < n_rings; ++ring) {
    for (int k = 0; k < n; ++k) {
      Polygon face{point(ring, k + 1), point(ring, k), point(ring + 1, k)};
      if (ring + 1 < n_rings) face.push_back(point(ring + 1, k + 1));
      faces.push_back(face);
    }
  }
  return faces;
}

/// A sphere seen from outside.
Shape sphere(const Vec3& center, double radius) {
  return [=](int n) {
    int level = 0;
    while (kCoarsest << level < n) ++level;
    Facets faces = icosphere(level + 1, radius, Facing::outwards);
    for (Polygon& face : faces) {
      for (Vec3& corner : face) corner += center;
    }
    return faces;
  };
}

std::vector<FactorComparison> compare_enclosure(const KnownFactor& known) {
  const auto& params = known.params;
  if (params.contains("half_angle_deg")) {
    const Shape wall = cone(params.at("half_angle_deg") * kPi / 180);
    const Shape base = disk(1, 0, true);
    return {compare(known, "F_cone_cone", wall, wall), compare(known, "F_cone_base", wall, base),
            compare(known, "F_base_cone", base, wall)};
  }
  if (params.contains("h")) {
    const double r = params.at("r");
    const double h = params.at("h");
    const Shape wall = cylinder_wall(r, h);
    const Shape base = disk(r, 0, true);
    return {compare(known, "F_base_top", base, disk(r, h, false)),
            compare(known, "F_base_wall", base, wall), compare(known, "F_wall_base", wall, base),
            compare(known, "F_wall_wall", wall, wall)};
  }
  const Shape base = disk(1, 0, true);
  return {compare(known, "F_hemi_hemi", hemisphere, hemisphere),
          compare(known, "F_hemi_base", hemisphere, base),
          compare(known, "F_base_hemi", base, hemisphere)};
}

/// A sphere half as large as its distance, beside a disk or over a corner of a rectangle.
std::vector<FactorComparison> compare_sphere(const KnownFactor& known) {
  const auto& params = known.params;
  if (params.contains("c")) {
    const double c = params.at("c");
    const Polygon rectangle =
        parallelogram(Vec3::Zero(), params.at("a") * Vec3::UnitX(), params.at("b") * Vec3::UnitY());
    return {compare(known, "F_sphere_rect", sphere({0, 0, c}, c / 2),
                    [&](int /*n*/) { return Facets{rectangle}; })};
  }
  const double h = params.at("h");
  return {compare(known, "F_sphere_disk", sphere({0, 0, h}, h / 2), disk(params.at("r"), 0, true))};
}

}  // namespace

std::vector<FactorComparison> compare_curved(const KnownFactor& known) {
  if (known.kind == "curved boundary") {
    const auto& params = known.params;
    const Shape low = disk(params.at("r1"), 0, true);
    const Shape high = disk(params.at("r2"), params.at("h"), false);
    return {compare(known, "F12", low, high), compare(known, "F21", high, low)};
  }
  if (known.kind == "closed curved enclosure") return compare_enclosure(known);
  if (known.kind == "curved") return compare_sphere(known);
  return {};
}

}  // namespace apps::validation
