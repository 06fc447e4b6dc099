// What comes before the first form factor: processor time, time and memory of each stage. Usage:
// setup_bench [PATCHES [SCENE [THREADS]]], default 100000 patches of the Cornell box, all cores.
#include <fmt/format.h>

#include <chrono>
#include <cstdlib>
#include <ctime>
#include <string>
#include <string_view>
#include <utility>

#include "bench/usage.h"
#include "io/scene/scene_file.h"
#include "meshing/patches/patches.h"
#include "radiosity/base/parallel.h"
#include "radiosity/exchange/exchange_evaluator.h"
#include "radiosity/exchange/openings.h"
#include "radiosity/visibility/coverage.h"
#include "radiosity/visibility/prepared_mesh.h"
#include "radiosity/visibility/regions.h"
#include "radiosity/visibility/visibility.h"

namespace {

using namespace radiosity;
using Clock = std::chrono::steady_clock;

double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// Runs a stage and prints what it took, with the most memory that there was so far.
template <typename Stage>
auto measured(std::string_view name, const Stage& stage) {
  const double start = processor_seconds();
  const Clock::time_point begin = Clock::now();
  auto result = stage();
  const std::chrono::duration<double> seconds = Clock::now() - begin;
  fmt::print("{:22} {:8.2f} s of processors {:8.2f} s {:8.0f} MB\n", name,
             processor_seconds() - start, seconds.count(), bench::peak_megabytes());
  return result;
}

/// What goes on to an operator, in its order.
void measure_needed(const Scene& scene, long n_patches) {
  const PatchMesh mesh = measured("make_patches", [&] {
    return n_patches > 0 ? meshing::make_patches(scene, {.n_patches = n_patches})
                         : meshing::make_patches(scene, {});
  });
  fmt::print("{} patches\n", mesh.size());
  const Visibility visibility = measured("Visibility", [&] { return Visibility(mesh); });
  const double thickness = plane_thickness(mesh);
  const Coverage coverage =
      measured("find_coverage", [&] { return find_coverage(mesh, thickness); });
  measured("ExchangeEvaluator",
           [&] { return ExchangeEvaluator(mesh, visibility, coverage, {}).size(); });
  fmt::print("in all                 {:8.2f} s of processors {:17.0f} MB\n", processor_seconds(),
             bench::peak_megabytes());
  // Parts of the evaluator, and what is asked beside it.
  measured("find_regions", [&] { return find_regions(mesh, visibility, thickness).size(); });
  const PreparedMesh prepared = measured("PreparedMesh", [&] { return PreparedMesh(mesh); });
  measured("PairKernel", [&] { return PairKernel(prepared, 1e-7).tolerance(); });
  measured("is_enclosed", [&] { return is_enclosed(mesh, visibility, 1e-2, 0); });
}

}  // namespace

int main(int argc, char** argv) {
  constexpr long kPatches = 100000;
  const ThreadLimit threads(argc > 3 ? std::strtoul(argv[3], nullptr, 10) : 0);
  const std::string path = argc > 2 ? argv[2] : RADIOSITY_SCENES "/cornell-box.json";
  const Scene scene = measured("read_scene", [&] { return io::read_scene(path); });
  measure_needed(scene, argc > 1 && argv[1][0] != '-' ? std::atol(argv[1]) : kPatches);
}
