// What adaptive patches take with dense and with compressed form factors.
//
// adaptive_bench SCENE PATCHES TRANSPORT [compare]
// SCENE: cornell-box, furnished-room... (of scenes/). TRANSPORT: auto, dense or compressed. Refines
// at 1e-2 of the form factors until so many patches are spent; prints rounds, the estimated error,
// wall and processor seconds, memory. With `compare` also what a dense and a compressed operator of
// these patches say of the groups to divide, and how long that takes.

#include <fmt/format.h>

#include <chrono>
#include <cstdlib>
#include <string>
#include <vector>

#include "bench/usage.h"
#include "io/scene/scene_file.h"
#include "meshing/adaptive/adaptive.h"
#include "radiosity/assembly/make_dense_transport.h"
#include "radiosity/compressed/make_compressed_transport.h"
#include "radiosity/scene/radiometry.h"
#include "radiosity/solve/refinement.h"
#include "radiosity/solve/solve.h"

namespace {

using namespace radiosity;
using bench::peak_megabytes;
using bench::processor_seconds;

TransportKind kind_named(const std::string& name) {
  if (name == "dense") return TransportKind::dense;
  return name == "compressed" ? TransportKind::compressed : TransportKind::automatic;
}

RefinementIndicator timed_indicator(const PatchMesh& mesh, const Transport& transport,
                                    const Solution& solution) {
  const double start = processor_seconds();
  RefinementIndicator result = refinement_indicator(mesh, transport, solution);
  fmt::print("indicator: {:.2f} s of processors\n", processor_seconds() - start);
  return result;
}

void compare(const Scene& scene, const meshing::AdaptiveMesh& made) {
  const ExpectedLight light{exitance(scene, made.mesh), reflectance(scene, made.mesh)};
  const auto compressed =
      make_compressed_transport(made.mesh, made.visibility, {.tolerance = 1e-2}, light);
  const Solution solution = solve(*compressed, light.exitance, light.reflectance);
  const RefinementIndicator found = timed_indicator(made.mesh, *compressed, solution);
  const auto dense = make_dense_transport(made.mesh, made.visibility, {.tolerance = 1e-2});
  const RefinementIndicator expected = timed_indicator(made.mesh, *dense, solution);
  const double all = expected.squared_error.sum();
  fmt::print("sum of the squared errors {:.4f} of that by rows\n", found.squared_error.sum() / all);
  for (const double share : {0.5, 0.8}) {
    std::vector<bool> is_marked(found.groups.n_groups, false);
    const std::vector<Index> marked = patches_to_refine(found, share, made.mesh.size());
    for (const Index i : marked) is_marked[found.groups.group_of[i]] = true;
    double held = 0;
    for (Index g = 0; g < found.groups.n_groups; ++g) {
      if (is_marked[g]) held += expected.squared_error[g];
    }
    fmt::print("{} patches for {}, {} by rows; they hold {:.4f} by these\n", marked.size(), share,
               patches_to_refine(expected, share, made.mesh.size()).size(), held / all);
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4) {
    fmt::print(stderr, "usage: adaptive_bench SCENE PATCHES TRANSPORT [compare]\n");
    return 2;
  }
  const Scene scene = io::read_scene(RADIOSITY_SCENES "/" + std::string(argv[1]) + ".json");
  const meshing::AdaptiveMesh made =
      meshing::make_adaptive_patches(scene, {.tolerance = 1e-9,
                                             .max_patches = std::atol(argv[2]),
                                             .transport = {.tolerance = 1e-2},
                                             .choice = {.kind = kind_named(argv[3])}});
  fmt::print("{} patches in {} rounds, error {:.2e}: {:.1f} s, {:.1f} s of processors, {:.0f} MB\n",
             made.mesh.size(), made.refinement.n_rounds, made.refinement.error,
             made.refinement.seconds, processor_seconds(), peak_megabytes());
  const AssemblyReport& report = made.transport->report();
  fmt::print("operator: {:.1f} MB, {}\n", 1e-6 * static_cast<double>(made.transport->bytes()),
             report.compression ? fmt::format("verified {:.2e}", report.compression->verified_error)
                                : "dense");
  if (argc > 4) compare(scene, made);
  return 0;
}
