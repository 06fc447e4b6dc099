/// Whether default patches keep light out and their errors hold. Usage: walled_rooms_bench [N_ROOMS
/// [FIRST_SEED [N_PATCHES]]]: huts whose walls stand on, abut and cross each other (20 from seed 1,
/// about 700 patches), each sealed and with an opening. Prints the most light within the sealed
/// one, which is to be 0, and the share of the patches of the open one within two standard errors
/// of patches divided into four. Returns 1 unless all are dark and 95 % of the patches within in nine rooms
/// of ten.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <vector>

#include "meshing/contact_lines.h"
#include "meshing/patches.h"
#include "radiosity/radiosity.h"
#include "tests/support/hung_boxes.h"
#include "tests/support/walled_rooms.h"

namespace {

using namespace radiosity;
using test::Hut;
using test::WalledRoom;

constexpr double kCoverage = 0.95;

Solution solve_patches(const Scene& scene, const PatchMesh& mesh, bool estimates) {
  const Visibility visibility(mesh);
  const auto transport =
      make_transport(mesh, visibility, {.tolerance = 1e-3, .closed = Closed::no});
  Solution solution = solve(*transport, exitance(scene, mesh), reflectance(scene, mesh));
  if (!estimates) return solution;
  return with_discretisation_error(solution, discretisation_error(mesh, *transport, solution));
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
  return values[values.size() / 2];
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
  if (std::getenv("PAIRS")) {
    double total = 0;
    for (double a : mesh.area) total += a;
    const PatchMesh as_is = meshing::make_patches(room.scene);
    double total0 = 0;
    for (double a : as_is.area) total0 += a;
    fmt::print("area {} {} crossed {}\n", total, total0, meshing::crossed_patches(mesh).size());
    const auto lines = meshing::polygon_contact_lines(as_is);
    for (const auto& l : lines[0]) {
      const Vec3 a = room.rotation.transpose() * l[0];
      const Vec3 b = room.rotation.transpose() * l[1];
      fmt::print("line {} {} - {} {}\n", a.x(), a.y(), b.x(), b.y());
    }
    const Visibility visibility(mesh);
    const auto transport =
        make_transport(mesh, visibility, {.tolerance = 1e-3, .closed = Closed::no});
    for (Index i = 0; i < mesh.size(); ++i) {
      if (!room.looks_inside(mesh, i)) continue;
      const Eigen::VectorXd row = transport->row(i);
      for (Index j = 0; j < mesh.size(); ++j) {
        if (row[j] == 0 || room.looks_inside(mesh, j)) continue;
        fmt::print("{} -> {} {}\n", i, j, row[j]);
        for (Index p : {i, j}) {
          fmt::print("   {} {} n {} {} {}: ", p, mesh.surface_names[mesh.surface[p]], (room.rotation.transpose()*mesh.normal[p]).x(), (room.rotation.transpose()*mesh.normal[p]).y(), (room.rotation.transpose()*mesh.normal[p]).z());
          for (int k = 0; k < mesh.n_corners(p); ++k) {
            const Vec3 x = room.rotation.transpose() * mesh.corner(p, k);
            fmt::print(" ({:.6f} {:.6f} {:.6f})", x.x(), x.y(), x.z());
          }
          fmt::print("\n");
        }
      }
    }
  }
  Dark dark;
  for (Index i = 0; i < mesh.size(); ++i) {
    if (!room.looks_inside(mesh, i)) continue;
    ++dark.n_patches;
    if (solution.irradiance(i, 0) > 0 && std::getenv("WHERE")) {
      const Vec3 x = room.rotation.transpose() * mesh.centroid[i];
      fmt::print("  {} {} at {} {} {} area {}: {}\n", i, mesh.surface_names[mesh.surface[i]], x.x(), x.y(), x.z(), mesh.area[i], solution.irradiance(i, 0));
    }
    dark.brightest = std::max(dark.brightest, solution.irradiance(i, 0));
  }
  return dark;
}

bool test_room(std::uint64_t seed, long n_patches) {
  const Dark dark = test_sealed(seed, n_patches);
  if (std::getenv("SEALED")) { fmt::print("{} {} {}\n", seed, dark.n_patches, dark.brightest); return dark.brightest == 0; }
  const WalledRoom room = test::make_walled_room(seed, Hut::open);
  const PatchMesh mesh = meshing::make_patches(room.scene, {.n_patches = n_patches});
  const auto crossed = meshing::crossed_patches(mesh).size();
  const std::clock_t start = std::clock();
  const Solution solution = solve_patches(room.scene, mesh, true);
  const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  const PatchMesh finer = test::divided_into_four(mesh);
  const Eigen::MatrixXd truth =
      test::means_of_four(finer, solve_patches(room.scene, finer, false).radiosity);
  std::vector<double> errors;
  std::vector<double> intervals;
  Index n_within = 0;
  for (Index i = 0; i < mesh.size(); ++i) {
    errors.push_back(std::abs(solution.radiosity(i, 0) - truth(i, 0)));
    intervals.push_back(2 * solution.radiosity_error(i, 0));
    if (errors.back() <= intervals.back()) ++n_within;
  }
  const double share = static_cast<double>(n_within) / static_cast<double>(mesh.size());
  fmt::print("{:5} {:8.1e} {:6} {:8.2e} {:6} {:8} {:8.1e} {:8.1f} {:10.2e} {:10.2e} {:8.1f}\n", seed,
             room.scene.precision, dark.n_patches, dark.brightest, mesh.size(), crossed,
             sharpest(mesh), 100 * share, median(errors), median(intervals), seconds);
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
             "digits/m", "inside", "light", "n", "crossed", "sine", "within/%", "|error|", "2 sigma",
             "s");
  int n_good = 0;
  for (int i = 0; i < n_rooms; ++i) n_good += test_room(first + i, n_patches) ? 1 : 0;
  fmt::print("{} of {} rooms are good\n", n_good, n_rooms);
  return 10 * n_good >= 9 * n_rooms ? 0 : 1;
}
