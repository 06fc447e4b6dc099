/// Proofs, factors between surfaces and closure of generated scenes against the oracle, by family.
/// Usage: families_bench [SCENES_PER_FAMILY [SEED [PAIRS_PER_SCENE [TOLERANCE [FAMILY]]]]]. Every
/// scene is varied at random and divided into one of five numbers of patches.

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <string>

#include "tests/support/family_checks.h"
#include "tests/support/scene_variations.h"

namespace {

using namespace radiosity::test;

struct Arguments {
  int n_scenes = 30;
  std::uint64_t seed = 1;
  long n_pairs = 30000;
  double tolerance = 1e-2;
  std::string family;  // all if empty
};

Findings run(Family family, const Arguments& arguments) {
  constexpr std::array<long, 5> kPatches{0, 100, 300, 1000, 2000};
  Findings sum;
  for (int k = 0; k < arguments.n_scenes; ++k) {
    const std::uint64_t seed = arguments.seed + k;
    const FamilyScene original = make_family_scene(family, seed);
    const FamilyScene scene = vary(original, random_variation(seed));
    CheckOptions options{.tolerance = arguments.tolerance,
                         .n_pairs = arguments.n_pairs,
                         .n_cluster_pairs = 2000,
                         .n_rays = 10000,
                         .n_surfaces = 40,
                         .seed = seed};
    if (const long n = kPatches[k % kPatches.size()]; n > 0) options.n_patches = n;
    sum += check_scene(scene, options);
  }
  return sum;
}

void print_head() {
  fmt::print(
      "{:<13} {:>6} {:>8} {:>9} {:>6} {:>9} {:>6} {:>8} {:>6} {:>8} {:>6} {:>7} {:>6} {:>6} "
      "{:>8} {:>8} {:>7}\n",
      "family", "scenes", "patches", "visible", "wrong", "hidden", "wrong", "clusters", "wrong",
      "factors", "wrong", "closed", "missed", "open", "row sum", "escaped", "CPU s");
}

void print_row(std::string_view name, const Findings& f, double seconds) {
  fmt::print(
      "{:<13} {:>6} {:>8} {:>9} {:>6} {:>9} {:>6} {:>8} {:>6} {:>8} {:>6} {:>7} {:>6} {:>6} "
      "{:>8.1e} {:>8.1e} {:>7.1f}\n",
      name, f.n_scenes - f.n_refused, f.n_patches, f.n_visible,
      f.n_wrong_visible + f.n_wrong_values, f.n_hidden, f.n_wrong_hidden, f.n_cluster_verdicts,
      f.n_wrong_clusters, f.n_factors, f.n_wrong_factors, f.n_closed, f.n_not_closed, f.n_open_rows,
      f.worst_row_sum, f.escaped, seconds);
}

double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

}  // namespace

int main(int argc, char** argv) {
  Arguments arguments;
  if (argc > 1) arguments.n_scenes = std::atoi(argv[1]);
  if (argc > 2) arguments.seed = std::strtoull(argv[2], nullptr, 10);
  if (argc > 3) arguments.n_pairs = std::atol(argv[3]);
  if (argc > 4) arguments.tolerance = std::atof(argv[4]);
  if (argc > 5) arguments.family = argv[5];
  print_head();
  Findings all;
  for (const Family family : kFamilies) {
    if (!arguments.family.empty() && family_name(family) != arguments.family) continue;
    const double start = cpu_seconds();
    const Findings found = run(family, arguments);
    print_row(family_name(family), found, cpu_seconds() - start);
    std::fflush(stdout);
    all += found;
  }
  print_row("all", all, cpu_seconds());
  for (const std::string& failure : all.failures) fmt::print("{}\n", failure);
}
