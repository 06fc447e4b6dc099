#include "radiosity/scene/winding.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>

#include "tests/support/shapes.h"

namespace radiosity {
namespace {

/// A room with walls of n x n patches each, with a shell of two layers in it.
SurfacePieces room_with_shell(int n) {
  PatchMesh mesh;
  test::add_box(mesh, {0, 0, 0}, {4, 3, 2}, n, test::Facing::inwards);
  test::add_box(mesh, {1, 1, 0.5}, {3, 2, 1.5}, n, test::Facing::outwards);
  test::add_box(mesh, {1.2, 1.2, 0.6}, {2.8, 1.8, 1.4}, n, test::Facing::inwards);
  std::vector<std::int32_t> patches(mesh.size());
  std::iota(patches.begin(), patches.end(), 0);
  return find_surface_pieces(mesh, patches, 1e-10);
}

TEST(WindingNumber, IsThatOfAllFacetsOneByOne) {
  const SurfacePieces pieces = room_with_shell(20);
  ASSERT_EQ(pieces.pieces.size(), 3U);
  std::mt19937_64 random(7);  // NOLINT: fixed seed
  std::uniform_real_distribution<double> uniform(0, 1);
  int n_inside = 0;
  for (const SurfacePiece& piece : pieces.pieces) {
    const WindingNumber winding(pieces, piece);
    for (int k = 0; k < 2000; ++k) {
      Vec3 point(6 * uniform(random) - 1, 5 * uniform(random) - 1, 4 * uniform(random) - 1);
      // Every other one close to a facet, on either side.
      if (k % 2 == 1) {
        const std::int32_t f = piece.facets[random() % piece.facets.size()];
        const std::span<const Vec3> outline = pieces.outline(f);
        const double height = (k % 4 == 1 ? 1 : -1) * std::pow(10, -6 * uniform(random)) * 0.1;
        point = outline[0] + 0.9 * uniform(random) * (outline[2] - outline[0]) +
                height * pieces.normal[f];
      }
      const int expected = winding_number(pieces, piece, point);
      EXPECT_EQ(winding.about(point), expected) << point.transpose();
      n_inside += expected != 0 ? 1 : 0;
    }
  }
  EXPECT_GT(n_inside, 1000);
}

}  // namespace
}  // namespace radiosity
