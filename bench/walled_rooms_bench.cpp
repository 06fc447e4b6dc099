/// Whether default patches keep light out and their errors hold. Usage: walled_rooms_bench [N_ROOMS
/// [FIRST_SEED [N_PATCHES]]]: huts whose walls stand on, abut and cross each other (20 from seed 1,
/// about 700 patches), each sealed and with an opening. Prints the most light within the sealed
/// one, which is to be 0, and the share of the patches of the open one within two standard errors
/// of patches divided into four. Returns 1 unless both hold in nine rooms of ten.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <vector>

#include "meshing/patches/contact_lines.h"
#include "meshing/patches/patches.h"
#include "radiosity/radiosity.h"
#include "tests/support/hung_boxes.h"
#include "tests/support/walled_rooms.h"

namespace {

using namespace radiosity;
using test::Hut;
using test::WalledRoom;

constexpr double kCoverage = 0.95;
/// Of what the lamp emits: sums of four, and the iteration.
constexpr double kRounding = 1e-9 * 100;

Solution solve_patches(const Scene& scene, const PatchMesh& mesh, bool estimates) {
  const Visibility visibility(mesh);
  const auto transport =
      make_transport(mesh, visibility, {.tolerance = 1e-3, .closed = Closed::no});
  Solution solution = solve(*transport, exitance(scene, mesh), reflectance(scene, mesh));
  if (!estimates) return solution;
  return with_discretisation_error(solution, discretisation_error(mesh, *transport, solution));
}

/// Smallest sine of a patch's corner.
double sharpest(const PatchMesh& mesh) {
  double least = 1;
  for (Index i = 0; i < mesh.size(); ++i) {
    const int n = mesh.n_corners(i);
    for (int k = 0; k < n; ++k) {
      const Vec3 u = mesh.corner(i, (k + 1) % n) - mesh.corner(i, k);
      const Vec3 v = mesh.corner(i, (k + n - 1) % n) - mesh.corner(i, k);
      least = std::min(least, u.cross(v).norm() / (u.norm() * v.norm()));
    }
  }
  return least;
}

struct Dark {
  Index n_patches = 0;
  double brightest = 0;
};

Dark test_sealed(std::uint64_t seed, long n_patches) {
  const WalledRoom room = test::make_walled_room(seed, Hut::sealed);
  const PatchMesh mesh = meshing::make_patches(room.scene, {.n_patches = n_patches});
  const Solution solution = solve_patches(room.scene, mesh, false);
  Dark dark;
  for (Index i = 0; i < mesh.size(); ++i) {
    if (!room.looks_inside(mesh, i)) continue;
    ++dark.n_patches;
    dark.brightest = std::max(dark.brightest, solution.irradiance(i, 0));
  }
  return dark;
}

bool test_room(std::uint64_t seed, long n_patches) {
  const Dark dark = test_sealed(seed, n_patches);
  const WalledRoom room = test::make_walled_room(seed, Hut::open);
  const PatchMesh mesh = meshing::make_patches(room.scene, {.n_patches = n_patches});
  const auto crossed = meshing::crossed_patches(mesh).size();
  const std::clock_t start = std::clock();
  const Solution solution = solve_patches(room.scene, mesh, true);
  const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  const PatchMesh finer = test::divided_into_four(mesh);
  const Eigen::MatrixXd truth =
      test::means_of_four(finer, solve_patches(room.scene, finer, false).radiosity);
  const test::IntervalCheck check = test::check_intervals(solution, truth, kRounding);
  const double share = static_cast<double>(check.n_within) / static_cast<double>(mesh.size());
  fmt::print("{:5} {:8.1e} {:6} {:8.2e} {:6} {:8} {:8.1e} {:8.1f} {:10.2e} {:10.2e} {:8.1f}\n",
             seed, room.scene.precision, dark.n_patches, dark.brightest, mesh.size(), crossed,
             sharpest(mesh), 100 * share, check.error, check.interval, seconds);
  std::fflush(stdout);
  return dark.brightest == 0 && share >= kCoverage;
}

}  // namespace

int main(int argc, char** argv) {
  const bool has_rooms = argc > 1 && argv[1][0] != '-';  // options are for other benchmarks
  const int n_rooms = has_rooms ? std::atoi(argv[1]) : 20;
  const int first = argc > 2 ? std::atoi(argv[2]) : 1;
  const long n_patches = argc > 3 ? std::atol(argv[3]) : 700;
  fmt::print("{:>5} {:>8} {:>6} {:>8} {:>6} {:>8} {:>8} {:>8} {:>10} {:>10} {:>8}\n", "seed",
             "digits/m", "inside", "light", "n", "crossed", "sine", "within/%", "|error|",
             "2 sigma", "s");
  int n_good = 0;
  for (int i = 0; i < n_rooms; ++i) n_good += test_room(first + i, n_patches) ? 1 : 0;
  fmt::print("{} of {} rooms are good\n", n_good, n_rooms);
  return 10 * n_good >= 9 * n_rooms ? 0 : 1;
}
