/// How often the printed errors of the radiosity hold. Usage: error_bars_bench [N_ROOMS
/// [FIRST_SEED]]: rooms with boxes that hang near other surfaces, 20 from seed 1 by default, each
/// with the patches of a room (about 300 to 1,500) and with each of these divided into four, whose
/// solution is the truth. Prints for every room the share of the patches within two standard
/// errors and the medians; returns 1 unless 95 % of the patches are in nine rooms of ten.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <random>
#include <vector>

#include "meshing/patches/patches.h"
#include "radiosity/radiosity.h"
#include "tests/support/hung_boxes.h"

namespace {

using namespace radiosity;

constexpr double kCoverage = 0.95;

struct Solved {
  std::unique_ptr<Transport> transport;
  Solution solution;
  double assembly_seconds;  ///< of processor time
};

double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

Solved solve_patches(const Scene& scene, const PatchMesh& mesh) {
  const double start = cpu_seconds();
  const Visibility visibility(mesh);
  auto transport = make_transport(mesh, visibility, {.tolerance = 1e-3, .closed = Closed::yes});
  const double seconds = cpu_seconds() - start;
  Solution solution = solve(*transport, exitance(scene, mesh), reflectance(scene, mesh));
  return {std::move(transport), std::move(solution), seconds};
}

/// The share of patches within two standard errors.
double test_room(std::uint64_t seed) {
  const Scene scene = test::make_hung_boxes(seed);
  std::mt19937_64 random(seed);
  const auto n_patches =
      std::lround(300 * std::pow(5, std::generate_canonical<double, 53>(random)));
  const PatchMesh mesh = meshing::make_patches(scene, {.n_patches = n_patches});
  const Solved coarse = solve_patches(scene, mesh);
  const double start = cpu_seconds();
  const DiscretisationError discretisation =
      discretisation_error(mesh, *coarse.transport, coarse.solution);
  const double seconds = cpu_seconds() - start;
  const Solution solution = with_discretisation_error(coarse.solution, discretisation);

  const PatchMesh finer = test::divided_into_four(mesh);
  const Solved fine = solve_patches(scene, finer);
  const Eigen::MatrixXd truth = test::means_of_four(finer, fine.solution.radiosity);

  const test::IntervalCheck check = test::check_intervals(solution, truth);
  const double share = static_cast<double>(check.n_within) / static_cast<double>(mesh.size());
  fmt::print(
      "{:5} {:6} {:6} {:8.1f} {:10.2e} {:10.2e} {:8.1f} {:6.2f} {:8.2f} {:8.2f} {:5} {:8.1e}\n",
      seed, scene.surfaces.size() - 6, mesh.size(), 100 * share, check.error, check.interval,
      check.interval / check.error, discretisation.order, coarse.assembly_seconds, seconds,
      fine.transport->report().open_rows, fine.transport->report().closure_max);
  std::fflush(stdout);
  return share;
}

}  // namespace

int main(int argc, char** argv) {
  const bool has_rooms = argc > 1 && argv[1][0] != '-';  // options are for other benchmarks
  const int n_rooms = has_rooms ? std::atoi(argv[1]) : 20;
  const int first = argc > 2 ? std::atoi(argv[2]) : 1;
  fmt::print("{:>5} {:>6} {:>6} {:>8} {:>10} {:>10} {:>8} {:>6} {:>8} {:>8} {:>5} {:>8}\n", "seed",
             "boxes", "n", "within/%", "|error|", "2 sigma", "ratio", "order", "F/s", "errors/s",
             "open", "closure");
  int n_good = 0;
  for (int i = 0; i < n_rooms; ++i) n_good += test_room(first + i) >= kCoverage ? 1 : 0;
  fmt::print("{} of {} rooms have {:.0f} % of their patches within\n", n_good, n_rooms,
             100 * kCoverage);
  return 10 * n_good >= 9 * n_rooms ? 0 : 1;
}
