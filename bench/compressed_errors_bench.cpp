// Whether the verified errors of compressed operators, and their errors of patches, are true:
// against dense operators at 5e-4, for kinds of scenes, tolerances and seeds.
//
// compressed_errors_bench [PATCHES]

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include "bench/bench_scenes.h"
#include "io/scene/scene_file.h"
#include "meshing/patches/patches.h"
#include "radiosity/assembly/make_dense_transport.h"
#include "radiosity/compressed/make_compressed_transport.h"

namespace {

using namespace radiosity;

constexpr double kReference = 5e-4;

std::vector<std::pair<std::string, PatchMesh>> make_meshes(long n) {
  std::vector<std::pair<std::string, PatchMesh>> meshes;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    meshes.emplace_back(fmt::format("cluttered room {}", seed), bench::cluttered_room(seed, n));
  }
  meshes.emplace_back("street canyon", bench::street_canyon(n));
  meshes.emplace_back("bumpy mesh", bench::bumpy_mesh(n));
  for (const std::string name : {"l-room", "cornell-box"}) {
    const Scene scene = io::read_scene(RADIOSITY_SCENES "/" + name + ".json");
    meshes.emplace_back(name, meshing::make_patches(scene, {.n_patches = n}));
  }
  return meshes;
}

/// 1, and light that varies.
Eigen::MatrixXd make_fields(const PatchMesh& mesh) {
  Eigen::MatrixXd fields = Eigen::MatrixXd::Ones(mesh.size(), 2);
  for (Index i = 0; i < mesh.size(); ++i) {
    fields(i, 1) = 1.5 + std::cos(2 * mesh.centroid[i].x() - mesh.centroid[i].z());
  }
  return fields;
}

}  // namespace

int main(int argc, char** argv) {
  const long n_patches = argc > 1 ? std::atol(argv[1]) : 1500;
  int n_beyond = 0;
  int n = 0;
  for (const auto& [name, mesh] : make_meshes(n_patches)) {
    const Visibility visibility(mesh);
    const auto dense = make_dense_transport(mesh, visibility, {.tolerance = kReference});
    const Eigen::MatrixXd fields = make_fields(mesh);
    const Eigen::MatrixXd expected = dense->apply(fields);
    for (const double tolerance : {3e-2, 1e-2, 3e-3}) {
      for (const std::uint64_t seed : {1, 2}) {
        const auto compressed =
            make_compressed_transport(mesh, visibility, {.tolerance = tolerance, .seed = seed});
        const Eigen::MatrixXd off = compressed->apply(fields) - expected;
        const Eigen::RowVectorXd relative =
            ((dense->area().transpose() * off.cwiseAbs2()).array() /
             (dense->area().transpose() * expected.cwiseAbs2()).array())
                .sqrt();
        const Eigen::ArrayXd errors = compressed->apply_error(fields.col(0)).col(0).array() + 1e-9;
        const auto within = [&](double sigmas) {
          const auto count = (off.col(0).array().abs() <= sigmas * errors).count();
          return 100 * static_cast<double>(count) / static_cast<double>(off.rows());
        };
        const double verified = compressed->report().compression->verified_error;
        const bool is_beyond = relative.maxCoeff() > verified;
        n_beyond += is_beyond ? 1 : 0;
        ++n;
        fmt::print(
            "{:<16} {} patches, asked {:g}: verified {:.2e}, true {:.2e}{}; within one error "
            "{:.1f} %, two {:.1f} %\n",
            name, mesh.size(), tolerance, verified, relative.maxCoeff(), is_beyond ? " BEYOND" : "",
            within(1), within(2));
      }
    }
  }
  fmt::print("{} of {} beyond what was verified\n", n_beyond, n);
  return 0;
}
