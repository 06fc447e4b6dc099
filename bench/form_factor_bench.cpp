/// Time and error of form factors on scenes with much partial occlusion, against a run of far
/// smaller tolerance. Usage: form_factor_bench SCENE N [TOLERANCE [REFERENCE_TOLERANCE [SEED]]],
/// with SCENE one of box-in-box (N cells along a wall, a multiple of 2: 15 N² triangles), canyon
/// (about N facets) and, of about N patches, cornell-box, furnished-room, turned-boxes (or
/// turned-boxes-9 for coordinates of 9 digits), many-boxes, spheres, bumpy-mesh, room, two-rooms,
/// plates-8 (any number of sides) and cluttered-room-1 (any seed). A reference tolerance of 0
/// leaves the comparison out. `form_factor_bench cluttered-rooms N [TOLERANCE
/// [REFERENCE_TOLERANCE]]` sums up 30 cluttered rooms. Set the number of threads with taskset.

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <ctime>
#include <optional>
#include <string>

#include "bench/bench_scenes.h"
#include "io/scene/scene_file.h"
#include "meshing/patches/patches.h"
#include "radiosity/base/parallel.h"
#include "radiosity/radiosity.h"

namespace {

using namespace radiosity;

/// The number in a name such as plates-8.
std::optional<long> number_after(const std::string& name, const std::string& start) {
  if (name.rfind(start, 0) != 0) return std::nullopt;
  return std::atol(name.c_str() + start.size());
}

PatchMesh make_scene(const std::string& name, long n) {
  if (name == "turned-boxes") return bench::turned_boxes(n, 17);
  if (const auto digits = number_after(name, "turned-boxes-")) {
    return bench::turned_boxes(n, static_cast<int>(*digits));
  }
  if (name == "many-boxes") return bench::many_boxes(n);
  if (name == "spheres") return bench::spheres(n);
  if (name == "bumpy-mesh") return bench::bumpy_mesh(n);
  if (name == "room") return bench::rooms(n, 1);
  if (name == "two-rooms") return bench::rooms(n, 2);
  if (const auto sides = number_after(name, "plates-")) {
    return bench::plates(n, static_cast<int>(*sides));
  }
  if (const auto seed = number_after(name, "cluttered-room-")) {
    return bench::cluttered_room(static_cast<std::uint64_t>(*seed), n);
  }
  if (name == "box-in-box") return bench::box_in_box(n);
  if (name == "canyon") return bench::street_canyon(n);
  if (name == "furnished-room") {
    return meshing::make_patches(io::read_scene(RADIOSITY_SCENES "/furnished-room.json"),
                                 {.n_patches = n});
  }
  return meshing::make_patches(io::read_scene(RADIOSITY_SCENES "/cornell-box.json"),
                               {.n_patches = n});
}

void print_run(const PatchMesh& mesh, const Transport& transport, double seconds, double cpu) {
  const AssemblyReport& report = transport.report();
  const double n_pairs =
      0.5 * static_cast<double>(mesh.size()) * static_cast<double>(mesh.size() - 1);
  const auto facing = static_cast<double>(report.facing);
  fmt::print("{} patches, {:.4g} pairs, {:.2f} s, {:.2f} s of processor time, {:.3g} pairs/s\n",
             mesh.size(), n_pairs, seconds, cpu, n_pairs / seconds);
  fmt::print(
      "of all pairs: facing {:.2f} %, visible {:.2f} %, hidden {:.2f} %, undecided {:.2f} %, "
      "partial {:.2f} %; undecided of facing {:.2f} %; {} rays\n",
      100 * facing / n_pairs, 100 * static_cast<double>(report.visible) / n_pairs,
      100 * static_cast<double>(report.hidden) / n_pairs,
      100 * static_cast<double>(report.undecided) / n_pairs,
      100 * static_cast<double>(report.partial) / n_pairs,
      100 * static_cast<double>(report.undecided) / facing, report.rays);
  double errors = 0;
  for (Index i = 0; i < mesh.size(); ++i)
    errors += mesh.area[i] * rows_of(transport).row_error(i).sum();
  const double sum = transport.area().dot(report.row_sums);
  fmt::print(
      "raw row sums: mean gap {:.3g}, largest {:.3g}; closed: {}; sum of errors / sum G {:.3g}\n",
      report.closure_mean, report.closure_max, report.closed, errors / sum);
}

/// What a run is worth, over all ordered pairs.
struct Comparison {
  double difference = 0, sum = 0, worst_row = 0, uncertain_sum = 0;
  double n_uncertain = 0, within_one = 0, within_two = 0, beyond_eight = 0, wrong_certain = 0;

  void add(const Comparison& other) {
    difference += other.difference;
    sum += other.sum;
    worst_row = std::max(worst_row, other.worst_row);
    uncertain_sum += other.uncertain_sum;
    n_uncertain += other.n_uncertain;
    within_one += other.within_one;
    within_two += other.within_two;
    beyond_eight += other.beyond_eight;
    wrong_certain += other.wrong_certain;
  }
};

/// Differences below this share of the row are of no interest.
constexpr double kTiny = 1e-9;

Comparison compare(const PatchMesh& mesh, const Transport& transport, const Transport& reference) {
  Comparison result;
  for (Index i = 0; i < mesh.size(); ++i) {
    const Eigen::VectorXd row = rows_of(transport).row(i);
    const Eigen::VectorXd error = rows_of(transport).row_error(i);
    const Eigen::VectorXd truth = rows_of(reference).row(i);
    const Eigen::VectorXd gap = (row - truth).cwiseAbs();
    const Eigen::VectorXd truth_error = rows_of(reference).row_error(i);
    const double tiny = kTiny * truth.sum();
    result.difference += mesh.area[i] * gap.sum();
    result.sum += mesh.area[i] * truth.sum();
    result.worst_row = std::max(result.worst_row, std::abs(row.sum() - truth.sum()));
    for (Index j = 0; j < mesh.size(); ++j) {
      if (error[j] == 0) {
        // What is hidden for sure may be small but uncertain to the reference.
        if (gap[j] > 1e-5 * truth[j] + 1e-12 + 8 * truth_error[j]) ++result.wrong_certain;
        continue;
      }
      result.uncertain_sum += mesh.area[i] * truth[j];
      ++result.n_uncertain;
      if (gap[j] <= error[j]) ++result.within_one;
      if (gap[j] <= 2 * error[j]) ++result.within_two;
      if (gap[j] > 8 * error[j] && gap[j] > tiny) ++result.beyond_eight;
    }
  }
  return result;
}

void print_comparison(const Comparison& c) {
  fmt::print(
      "sum |dG| / sum G = {:.3g}; worst row sum {:.3g}; uncertain entries hold {:.2f} % of "
      "all exchange; within one sigma {:.1f} %, two {:.1f} %, beyond eight: {} of {}; certain ones "
      "that differ: {}\n",
      c.difference / c.sum, c.worst_row, 100 * c.uncertain_sum / c.sum,
      100 * c.within_one / c.n_uncertain, 100 * c.within_two / c.n_uncertain, c.beyond_eight,
      c.n_uncertain, c.wrong_certain);
}

std::unique_ptr<Transport> timed(const PatchMesh& mesh, double tolerance, std::uint64_t seed) {
  const auto start = std::chrono::steady_clock::now();
  const std::clock_t start_cpu = std::clock();
  const Visibility visibility(mesh);
  auto transport = make_transport(mesh, visibility,
                                  {.tolerance = tolerance, .closed = Closed::no, .seed = seed});
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  const double cpu = static_cast<double>(std::clock() - start_cpu) / CLOCKS_PER_SEC;
  print_run(mesh, *transport, elapsed.count(), cpu);
  return transport;
}

void run(const std::string& name, long n, double tolerance, double reference_tolerance,
         std::uint64_t seed) {
  fmt::print("\n{} {} at {}\n", name, n, tolerance);
  const PatchMesh mesh = make_scene(name, n);
  const auto transport = timed(mesh, tolerance, seed);
  if (reference_tolerance <= 0) return;
  const auto reference = timed(mesh, reference_tolerance, seed + 1);
  print_comparison(compare(mesh, *transport, *reference));
}

/// Closed rooms with the seeds 1 to 30: how many keep the tolerance, and the errors of all entries.
void run_cluttered_rooms(long n, double tolerance, double reference_tolerance) {
  constexpr int kRooms = 30;
  Comparison all;
  int n_kept = 0;
  for (int seed = 1; seed <= kRooms; ++seed) {
    const PatchMesh mesh = bench::cluttered_room(static_cast<std::uint64_t>(seed), n);
    fmt::print("\nseed {}, {} polygons\n", seed, mesh.polygon.back() + 1);
    const auto transport = timed(mesh, tolerance, 0);
    const auto reference = timed(mesh, reference_tolerance, 1);
    const Comparison c = compare(mesh, *transport, *reference);
    print_comparison(c);
    n_kept += c.difference <= tolerance * c.sum ? 1 : 0;
    all.add(c);
  }
  fmt::print("\n{} of {} rooms keep {}; all together:\n", n_kept, kRooms, tolerance);
  print_comparison(all);
}

/// What docs/DESIGN.md quotes: on one thread, then the same on two, and the canyon.
void run_all() {
  {
    const ThreadLimit single(1);
    run("box-in-box", 6, 1e-3, 1e-6, 0);
    run("box-in-box", 12, 1e-3, 0, 0);
    run("box-in-box", 18, 1e-3, 0, 0);
    run("cornell-box", 4608, 1e-3, 0, 0);
    run("cornell-box", 18432, 1e-3, 0, 0);
  }
  const ThreadLimit both(2);
  fmt::print("\ntwo threads:\n");
  run("cornell-box", 4608, 1e-3, 0, 0);
  run("canyon", 22000, 1e-2, 0, 0);
}

}  // namespace

int main(int argc, char** argv) {
  const bool has_scene = argc > 2 && argv[1][0] != '-';
  if (!has_scene) {
    run_all();
    return 0;
  }
  const std::string name = argv[1];
  const long n = std::atol(argv[2]);
  const double tolerance = argc > 3 ? std::atof(argv[3]) : 1e-3;
  const double reference_tolerance = argc > 4 ? std::atof(argv[4]) : 0;
  if (name == "cluttered-rooms") {
    run_cluttered_rooms(n, tolerance, reference_tolerance > 0 ? reference_tolerance : 1e-5);
    return 0;
  }
  run(name, n, tolerance, reference_tolerance, argc > 5 ? std::strtoull(argv[5], nullptr, 10) : 0);
  return 0;
}
