// What an operator from a file takes, from reading it to the errors of a solution.
//
// stored_operator_bench FILE.h5 SCENE.json [REPEATS]
// FILE was written by `radiosity solve SCENE -o FILE`. Prints wall and processor seconds of each
// stage; of products with 1, 3, 4, 8 and 12 columns the medians.

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <string>
#include <vector>

#include "apps/terminal/machine.h"
#include "bench/usage.h"
#include "io/result/operator_file.h"
#include "io/scene/scene_file.h"
#include "radiosity/scene/radiometry.h"
#include "radiosity/solve/discretisation_error.h"
#include "radiosity/solve/solve.h"
#include "radiosity/visibility/visibility.h"

namespace {

using namespace radiosity;
using bench::peak_megabytes;
using bench::processor_seconds;

struct Taken {
  double wall = 0;        ///< s
  double processors = 0;  ///< s
};

/// What runs of a stage take.
template <typename Work>
Taken measure(const Work& work) {
  const auto start = std::chrono::steady_clock::now();
  const double processor = processor_seconds();
  work();
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  return {elapsed.count(), processor_seconds() - processor};
}

void print(const std::string& name, const Taken& taken) {
  fmt::print("{:<14} {:8.3f} s {:8.3f} s of processors, peak {:.0f} MB\n", name, taken.wall,
             taken.processors, peak_megabytes());
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

void print_products(const Transport& transport, int n_repeats) {
  for (const Index n_columns : {1, 3, 4, 8, 12}) {
    const Eigen::MatrixXd x = Eigen::MatrixXd::Random(transport.size(), n_columns);
    std::vector<double> wall;
    std::vector<double> processors;
    for (int k = 0; k < n_repeats; ++k) {
      const Taken taken = measure([&] { (void)transport.apply(x); });
      wall.push_back(taken.wall);
      processors.push_back(taken.processors);
    }
    print(fmt::format("{} columns", n_columns), {median(wall), median(processors)});
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    fmt::print(stderr, "usage: stored_operator_bench FILE.h5 SCENE.json [REPEATS]\n");
    return 2;
  }
  apps::keep_freed_memory();  // as the program does
  const Scene scene = io::read_scene(argv[2]);
  io::StoredOperator stored;
  print("reading", measure([&] { stored = io::read_operator(argv[1]); }));
  const PatchMesh& mesh = stored.mesh;
  const Transport& transport = *stored.transport;
  fmt::print("{} patches, {:.1f} MB\n", mesh.size(), 1e-6 * static_cast<double>(transport.bytes()));
  print("visibility", measure([&] { (void)Visibility(mesh); }));
  print_products(transport, argc > 3 ? std::atoi(argv[3]) : 5);
  Solution solution;
  for (const bool with_errors : {false, true}) {
    print(with_errors ? "with errors" : "solve", measure([&] {
            solution = solve(transport, exitance(scene, mesh), reflectance(scene, mesh),
                             {.estimates_errors = with_errors});
          }));
  }
  DiscretisationError error;
  print("patch size", measure([&] { error = discretisation_error(mesh, transport, solution); }));
  fmt::print("B {:.17g}, its errors {:.17g}, of patch size {:.17g}\n", solution.radiosity.sum(),
             solution.radiosity_error.sum(), error.error.sum());
  return 0;
}
