/// Time and error of form factors on scenes with much partial occlusion, against a run of far
/// smaller tolerance. Usage: form_factor_bench SCENE N [TOLERANCE [REFERENCE_TOLERANCE [SEED]]],
/// with SCENE one of box-in-box (N cells along a wall, a multiple of 2: 15 N² triangles),
/// cornell-box and furnished-room (about N patches) and canyon (about N facets). A reference
/// tolerance of 0 leaves the comparison out. Set the number of threads with taskset.

#include <fmt/format.h>

#include <chrono>
#include <cstdlib>
#include <ctime>
#include <string>

#include "bench_scenes.h"
#include "io/scene_file.h"
#include "meshing/patches.h"
#include "radiosity/radiosity.h"

namespace {

using namespace radiosity;

PatchMesh make_scene(const std::string& name, long n) {
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
  fmt::print("raw row sums: mean gap {:.3g}, largest {:.3g}; closed: {}\n", report.closure_mean,
             report.closure_max, report.closed);
}

struct Comparison {
  double difference = 0, sum = 0, worst_row = 0, uncertain_sum = 0;
  double n_uncertain = 0, within_one = 0, within_two = 0, wrong_certain = 0;
};

Comparison compare(const PatchMesh& mesh, const Transport& transport, const Transport& reference) {
  Comparison result;
  for (Index i = 0; i < mesh.size(); ++i) {
    const Eigen::VectorXd row = transport.row(i);
    const Eigen::VectorXd error = transport.row_error(i);
    const Eigen::VectorXd truth = reference.row(i);
    const Eigen::VectorXd gap = (row - truth).cwiseAbs();
    result.difference += mesh.area[i] * gap.sum();
    result.sum += mesh.area[i] * truth.sum();
    result.worst_row = std::max(result.worst_row, std::abs(row.sum() - truth.sum()));
    for (Index j = 0; j < mesh.size(); ++j) {
      if (error[j] == 0) {
        if (gap[j] > 1e-5 * truth[j] + 1e-12) ++result.wrong_certain;
        continue;
      }
      result.uncertain_sum += mesh.area[i] * truth[j];
      ++result.n_uncertain;
      if (gap[j] <= error[j]) ++result.within_one;
      if (gap[j] <= 2 * error[j]) ++result.within_two;
    }
  }
  return result;
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

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    fmt::print(
        "usage: form_factor_bench box-in-box|cornell-box|canyon N [TOLERANCE "
        "[REFERENCE_TOLERANCE [SEED]]]\n");
    return 2;
  }
  const PatchMesh mesh = make_scene(argv[1], std::atol(argv[2]));
  const double tolerance = argc > 3 ? std::atof(argv[3]) : 1e-3;
  const double reference_tolerance = argc > 4 ? std::atof(argv[4]) : 0;
  const auto transport = timed(mesh, tolerance, argc > 5 ? std::atol(argv[5]) : 0);
  if (reference_tolerance <= 0) return 0;
  const auto reference = timed(mesh, reference_tolerance, 1000);
  const Comparison c = compare(mesh, *transport, *reference);
  fmt::print(
      "sum |dG| / sum G = {:.3g}; worst row sum {:.3g}; uncertain entries hold {:.2f} % of "
      "all exchange; within one sigma {:.1f} %, two {:.1f} %; certain ones that differ: {}\n",
      c.difference / c.sum, c.worst_row, 100 * c.uncertain_sum / c.sum,
      100 * c.within_one / c.n_uncertain, 100 * c.within_two / c.n_uncertain, c.wrong_certain);
  return 0;
}
