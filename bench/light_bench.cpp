// The Cornell box in 3 and in 76 bands with the same form factors, and adaptive against uniform
// patches. Usage: light_bench [PATCHES], default 2000. One thread.
#include <fmt/format.h>

#include <cstdlib>
#include <ctime>
#include <utility>

#include "io/scene/scene_file.h"
#include "radiosity/radiosity.h"
#include "study/study.h"

namespace {

using namespace radiosity;

double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

double seconds_to_solve(const Scene& scene, const PatchMesh& mesh, const Transport& transport) {
  const double start = processor_seconds();
  const Solution solution = solve(transport, exitance(scene, mesh), reflectance(scene, mesh));
  const double seconds = processor_seconds() - start;
  fmt::print("{:3} bands: {:.3f} s, {} iterations, bound {:.1e}\n", scene.bands.count(), seconds,
             solution.iterations, solution.error_bound);
  return seconds;
}

void compare_bands(long n_patches) {
  const Scene rgb = io::read_scene(RADIOSITY_SCENES "/cornell-box.json");
  const Scene spectral = io::read_scene(RADIOSITY_SCENES "/cornell-box-spectral.json");
  const study::Study box = study::assemble(rgb, {.patches = {.n_patches = n_patches}});
  fmt::print("{} patches\n", box.mesh.size());
  const double three = seconds_to_solve(rgb, box.mesh, *box.transport);
  const double many = seconds_to_solve(spectral, box.mesh, *box.transport);
  fmt::print("ratio {:.2f}\n", many / three);
}

void refine(double tolerance) {
  Scene scene = io::read_scene(RADIOSITY_SCENES "/cornell-box.json");
  const double start = processor_seconds();
  const study::Study box = study::assemble(
      std::move(scene),
      {.patches = {.adaptive = true}, .tolerance = tolerance, .factor_tolerance = 1e-2});
  fmt::print("adaptive to {:g}: {} patches, {} rounds, error {:.2g}, {:.2f} s\n", tolerance,
             box.mesh.size(), box.refinement->n_rounds, box.refinement->error,
             processor_seconds() - start);
}

}  // namespace

int main(int argc, char** argv) {
  const ThreadLimit one(1);
  compare_bands(argc > 1 && argv[1][0] != '-' ? std::atol(argv[1]) : 2000);
  for (const double tolerance : {0.05, 0.02, 0.01}) refine(tolerance);
}
