// What a compressed operator takes and is worth.
//
// compressed_bench SCENE PATCHES TOLERANCE [dense]
// SCENE: cornell-box, furnished-room... (of scenes/), or canyon, bumpy, spheres, boxes. Prints wall
// and processor seconds of each stage, memory, numbers kept and form factors evaluated a patch, the
// verified error, and products of 1 and of 4 columns; with `dense` the same of a dense operator and
// how far the two are apart.

#include <fmt/format.h>
#include <sys/resource.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <string>

#include "bench/bench_scenes.h"
#include "io/scene/scene_file.h"
#include "meshing/patches/patches.h"
#include "radiosity/assembly/make_dense_transport.h"
#include "radiosity/compressed/make_compressed_transport.h"
#include "radiosity/scene/radiometry.h"
#include "radiosity/solve/solve.h"

namespace {

using namespace radiosity;

double processor_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_utime.tv_sec) +
         1e-6 * static_cast<double>(usage.ru_utime.tv_usec);
}

double peak_megabytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

/// Runs a stage and prints what it took.
template <typename Work>
auto timed(const std::string& name, const Work& work) {
  const auto start = std::chrono::steady_clock::now();
  const double processor = processor_seconds();
  auto result = work();
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  fmt::print("{:<14} {:8.2f} s {:8.2f} s of processors, peak {:.0f} MB\n", name, elapsed.count(),
             processor_seconds() - processor, peak_megabytes());
  return result;
}

struct Subject {
  PatchMesh mesh;
  ExpectedLight light;
};

Subject make_subject(const std::string& name, long n) {
  Subject subject;
  if (name == "canyon") {
    subject.mesh = bench::street_canyon(n);
  } else if (name == "bumpy") {
    subject.mesh = bench::bumpy_mesh(n);
  } else if (name == "spheres") {
    subject.mesh = bench::spheres(n);
  } else if (name == "boxes") {
    subject.mesh = bench::many_boxes(n);
  } else {
    const Scene scene = io::read_scene(RADIOSITY_SCENES "/" + name + ".json");
    subject.mesh = meshing::make_patches(scene, {.n_patches = n});
    subject.light = {exitance(scene, subject.mesh), reflectance(scene, subject.mesh)};
  }
  return subject;
}

double difference(const Transport& transport, const Eigen::MatrixXd& x, const Eigen::MatrixXd& y) {
  const auto norm = [&](const Eigen::MatrixXd& z) {
    return std::sqrt(transport.area().dot(z.cwiseAbs2().rowwise().sum()));
  };
  return norm(x - y) / norm(y);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4) {
    fmt::print(stderr, "usage: compressed_bench SCENE PATCHES TOLERANCE [dense]\n");
    return 2;
  }
  const double tolerance = std::atof(argv[3]);
  const Subject subject =
      timed("patches", [&] { return make_subject(argv[1], std::atol(argv[2])); });
  const PatchMesh& mesh = subject.mesh;
  const Visibility visibility = timed("visibility", [&] { return Visibility(mesh); });
  const auto compressed = timed("compressed", [&] {
    return make_compressed_transport(mesh, visibility, {.tolerance = tolerance}, subject.light);
  });
  const CompressionReport& report = *compressed->report().compression;
  fmt::print("{} patches: {:.1f} MB, {:.1f} numbers and {:.1f} form factors a patch\n", mesh.size(),
             1e-6 * static_cast<double>(compressed->bytes()), report.coefficients, report.entries);
  fmt::print("verified {:.2e} by {} rows in {} rounds, {:.2e} told by the blocks\n",
             report.verified_error, report.n_rows, report.n_rounds, report.estimated_error);
  const Eigen::MatrixXd ones = Eigen::MatrixXd::Ones(mesh.size(), 1);
  timed("1 column", [&] { return compressed->apply(ones); });
  timed("4 columns", [&] { return compressed->apply(ones.replicate(1, 4)); });
  Solution solution;
  if (subject.light.exitance.size() > 0) {
    solution = timed("solve", [&] {
      return solve(*compressed, subject.light.exitance, subject.light.reflectance);
    });
  }
  if (argc < 5) return 0;
  const auto dense = timed(
      "dense", [&] { return make_dense_transport(mesh, visibility, {.tolerance = tolerance}); });
  fmt::print("dense {:.1f} MB; F 1 off by {:.2e}\n", 1e-6 * static_cast<double>(dense->bytes()),
             difference(*dense, compressed->apply(ones), dense->apply(ones)));
  if (subject.light.exitance.size() > 0) {
    const Solution reference = solve(*dense, subject.light.exitance, subject.light.reflectance);
    fmt::print("B off by {:.2e}\n", difference(*dense, solution.radiosity, reference.radiosity));
  }
  return 0;
}
