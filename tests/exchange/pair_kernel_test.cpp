#include "radiosity/exchange/pair_kernel.h"

#include <gtest/gtest.h>

#include "meshing/patches/patches.h"
#include "tests/support/hung_boxes.h"

namespace radiosity {
namespace {

/// Rules that are kept and rules that are made anew have the same points.
TEST(PairKernel, IsTheSameToTheLastBitWhateverIsKept) {
  const PreparedMesh mesh(meshing::make_patches(test::make_hung_boxes(3), {.n_patches = 400}));
  const PairKernel all(mesh, 1e-7);
  const PairKernel some(mesh, 1e-7, mesh.size() * 128);  // order 2
  const PairKernel none(mesh, 1e-7, 0);
  int n_asked = 0;
  for (Index i = 0; i < mesh.size(); ++i) {
    for (Index j = i + 1; j < mesh.size(); ++j) {
      const Blocking front_i = all.in_front(i, j);
      const Blocking front_j = all.in_front(j, i);
      if (front_i == Blocking::none || front_j == Blocking::none) continue;
      const double expected = all.unoccluded(i, j, front_i, front_j);
      ASSERT_EQ(some.unoccluded(i, j, front_i, front_j), expected) << i << ", " << j;
      ASSERT_EQ(none.unoccluded(i, j, front_i, front_j), expected) << i << ", " << j;
      ++n_asked;
    }
  }
  EXPECT_GT(n_asked, 10000);
}

}  // namespace
}  // namespace radiosity
