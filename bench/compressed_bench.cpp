// What a compressed operator takes and is worth.
//
// compressed_bench SCENE PATCHES TOLERANCE [dense | rows N]
// SCENE: cornell-box, furnished-room... (of scenes/), or canyon, bumpy, spheres, boxes. Prints wall
// and processor seconds of each stage, memory, numbers kept and form factors evaluated a patch, the
// verified error, and products of 1 and of 4 columns; with `dense` the same of a dense operator and
// how far the two are apart; with `rows`, on N random rows that are evaluated a hundred times more
// exactly, how far off F 1 and F B are.

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <random>
#include <string>
#include <vector>

#include "bench/bench_scenes.h"
#include "bench/usage.h"
#include "io/scene/scene_file.h"
#include "meshing/patches/patches.h"
#include "radiosity/assembly/make_dense_transport.h"
#include "radiosity/base/parallel.h"
#include "radiosity/compressed/make_compressed_transport.h"
#include "radiosity/exchange/exchange_evaluator.h"
#include "radiosity/scene/radiometry.h"
#include "radiosity/solve/solve.h"
#include "radiosity/visibility/coverage.h"

namespace {

using namespace radiosity;
using bench::peak_megabytes;
using bench::processor_seconds;

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

/// What an operator is off by on rows drawn by area.
void check_rows(const Subject& subject, const Visibility& visibility, const Transport& compressed,
                const Eigen::MatrixXd& light, long n_rows, double tolerance) {
  const PatchMesh& mesh = subject.mesh;
  Eigen::MatrixXd fields(mesh.size(), 1 + light.cols());
  fields << Eigen::VectorXd::Ones(mesh.size()), light;
  const Eigen::MatrixXd gathered = compressed.apply(fields);
  const Eigen::VectorXd errors = compressed.apply_error(fields.col(0));
  std::mt19937_64 random(99);  // NOLINT: fixed seed
  std::discrete_distribution<std::int32_t> draw(mesh.area.begin(), mesh.area.end());
  std::vector<std::int32_t> rows(n_rows);
  for (std::int32_t& row : rows) row = draw(random);

  const Coverage coverage = find_coverage(mesh, plane_thickness(mesh));
  const ExchangeEvaluator evaluator(mesh, visibility, coverage,
                                    {.tolerance = 1e-2 * tolerance, .seed = 12345});
  const auto& order = evaluator.tree().order;
  Eigen::MatrixXd off(n_rows, fields.cols());
  parallel_for(n_rows, [&](std::ptrdiff_t k) {
    ExchangeEvaluator::Worker worker = evaluator.worker();
    Eigen::RowVectorXd sum = Eigen::RowVectorXd::Zero(fields.cols());
    evaluator.visit_row(rows[k], worker, [&](Index column, const ExchangeArea& entry) {
      sum += entry.value / mesh.area[rows[k]] * fields.row(order[column]);
    });
    off.row(k) = gathered.row(rows[k]) - sum;
  });
  double largest = 0;
  for (Index c = 0; c < fields.cols(); ++c) {
    const double size =
        compressed.area().dot(gathered.col(c).cwiseAbs2()) / compressed.area().sum();
    if (size > 0)
      largest = std::max(largest,
                         std::sqrt(off.col(c).squaredNorm() / static_cast<double>(n_rows) / size));
  }
  long n_within = 0;
  for (long k = 0; k < n_rows; ++k) {
    n_within += std::abs(off(k, 0)) <= 2 * errors[rows[k]] + 1e-9 ? 1 : 0;
  }
  fmt::print("{} rows: off by {:.2e}; {:.1f} % within two of their errors\n", n_rows, largest,
             100 * static_cast<double>(n_within) / static_cast<double>(n_rows));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4) {
    fmt::print(stderr, "usage: compressed_bench SCENE PATCHES TOLERANCE [dense | rows N]\n");
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
  if (argc > 5 && std::string(argv[4]) == "rows") {
    const Eigen::MatrixXd light =
        solution.radiosity.size() > 0 ? solution.radiosity : Eigen::MatrixXd(mesh.size(), 0);
    timed("rows", [&] {
      check_rows(subject, visibility, *compressed, light, std::atol(argv[5]), tolerance);
      return 0;
    });
    return 0;
  }
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
