/// Scenes of the kinds that people have, generated, turned, moved, rounded and divided: every proof
/// of visibility, every factor between surfaces and every row sum against brute force.

#include <gtest/gtest.h>

#include <string>

#include "support/family_checks.h"

namespace {

using namespace radiosity;
using namespace radiosity::test;

constexpr std::uint64_t kSeed = 1;

class Families : public testing::TestWithParam<Family> {};

std::string test_name(const testing::TestParamInfo<Family>& info) {
  std::string name(family_name(info.param));
  std::replace(name.begin(), name.end(), ' ', '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(Scenes, Families, testing::ValuesIn(kFamilies), test_name);

std::string lines(const std::vector<std::string>& failures) {
  std::string text;
  for (const std::string& failure : failures) text += "\n  " + failure;
  return text;
}

TEST_P(Families, AgreeWithTheOracle) {
  constexpr int kScenes = 16;
  constexpr std::array<long, 4> kPatches{0, 100, 0, 300};
  Findings found;
  for (int k = 0; k < kScenes; ++k) {
    const std::uint64_t seed = kSeed + k;
    const FamilyScene scene = vary(make_family_scene(GetParam(), seed), random_variation(seed));
    CheckOptions options{.tolerance = k % 2 == 0 ? 1e-2 : 1e-3, .n_surfaces = 12, .seed = seed};
    if (const long n = kPatches[k % kPatches.size()]; n > 0) options.n_patches = n;
    found += check_scene(scene, options);
  }
  EXPECT_EQ(found.n_wrong_visible, 0) << "of " << found.n_visible;
  EXPECT_EQ(found.n_wrong_hidden, 0) << "of " << found.n_hidden;
  EXPECT_EQ(found.n_wrong_values, 0);
  EXPECT_EQ(found.n_wrong_clusters, 0) << "of " << found.n_cluster_verdicts;
  EXPECT_EQ(found.n_wrong_factors, 0) << "of " << found.n_factors;
  EXPECT_EQ(found.n_not_closed, 0) << "of " << found.n_closed;
  EXPECT_EQ(found.n_open_rows, 0);
  EXPECT_EQ(found.n_wrong_row_sums, 0);
  EXPECT_LE(found.escaped, 1e-5);
  EXPECT_GT(found.n_visible, 1000);
  // Only needles may be too thin for their digits.
  if (GetParam() != Family::crossing) EXPECT_EQ(found.n_refused, 0);
  if (HasFailure()) ADD_FAILURE() << lines(found.failures);
}

}  // namespace
