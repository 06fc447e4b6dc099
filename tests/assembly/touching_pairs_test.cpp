/// Pairs that touch, partly hidden: no rule integrates what a point near the contact sees, and what
/// is wrong there must neither go into the rest nor out of the error.

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "radiosity/assembly/make_dense_transport.h"
#include "radiosity/operator/surface_factors.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/visibility/visibility.h"
#include "tests/support/hung_boxes.h"
#include "tests/support/shapes.h"

namespace radiosity {
namespace {

/// Beyond so many standard errors means a right value is once in 10,000 times.
constexpr double kLikely = 3.9;
constexpr double kAskedOfPairs = 1e-6;
/// Relative error of the kernel where nothing is in the way.
constexpr double kKernelError = 1e-9;

struct Factor {
  double value;
  double error;
};

/// From surface 0 to surface 1.
Factor first_factor(const PatchMesh& mesh) {
  const auto transport = make_dense_transport(mesh, Visibility(mesh),
                                              {.tolerance = kAskedOfPairs, .closed = Closed::no});
  return {surface_form_factors(mesh, *transport)(0, 1),
          surface_form_factor_errors(mesh, *transport)(0, 1)};
}

void add_polygon(PatchMesh& mesh, const std::vector<Vec3>& corners) {
  const auto first = static_cast<std::int32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), corners.begin(), corners.end());
  const auto surface = static_cast<std::int32_t>(mesh.surface_names.size());
  mesh.surface_names.push_back("surface " + std::to_string(surface));
  mesh.surface_two_sided.push_back(false);
  mesh.add_patch({first, first + 1, first + 2, corners.size() > 3 ? first + 3 : -1}, surface,
                 surface);
}

/// A floor of four corners and a triangle that stands on one of them, a sloping plate between.
PatchMesh floor_and_triangle(double width, double depth, double height, const Vec3& plate,
                             const Vec3& size) {
  PatchMesh mesh;
  add_polygon(mesh, {Vec3(width, 0, 0), Vec3(width, depth, 0), Vec3(0.55 * width, 0.6 * depth, 0),
                     Vec3(0.55 * width, 0.2 * depth, 0)});
  add_polygon(mesh, {Vec3(width, depth, 0), Vec3(width, depth, height), Vec3(0, depth, height)});
  std::vector<Vec3> corners{plate, plate + Vec3(size.x(), 0, size.z()), plate + size,
                            plate + Vec3(0, size.y(), 0)};
  add_polygon(mesh, corners);
  std::swap(corners[1], corners[3]);
  add_polygon(mesh, corners);
  return mesh;
}

TEST(TouchingPairs, AreWhatTheirPartsAreTogether) {
  std::mt19937_64 random(20);
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  int n_hidden = 0;
  for (int k = 0; k < 12; ++k) {
    const double width = between(0.8, 2);
    const double depth = between(0.8, 2);
    const double height = between(0.8, 2);
    const Vec3 plate(between(0.1, 0.4) * width, between(0.1, 0.4) * depth,
                     between(0.3, 0.5) * height);
    const Vec3 size(between(0.2, 0.5) * width, between(0.2, 0.5) * depth, 0.1 * height);
    const PatchMesh mesh = floor_and_triangle(width, depth, height, plate, size);
    const Factor whole = first_factor(mesh);
    const Factor parts = first_factor(test::divided_into_four(test::divided_into_four(mesh)));
    EXPECT_NEAR(whole.value, parts.value,
                kLikely * std::hypot(whole.error, parts.error) + kKernelError * whole.value)
        << k;
    EXPECT_LE(whole.error, kAskedOfPairs) << k;
    n_hidden += whole.error > 1e-9;
  }
  EXPECT_GE(n_hidden, 6);  // of others the factor is exact
}

}  // namespace
}  // namespace radiosity
