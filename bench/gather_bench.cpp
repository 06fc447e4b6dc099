/// Time of a gathered picture. Usage: gather_bench [SCENE N [SIDE [SAMPLES]]], with SCENE the name
/// of a file in scenes/ that has a camera, in about N patches, and SIDE x SIDE pixels; by default
/// the Cornell box in 2000, 512 x 512. Set the number of threads with taskset.

#include <fmt/format.h>

#include <chrono>
#include <cstdlib>
#include <ctime>
#include <string>

#include "io/scene/scene_file.h"
#include "radiosity/radiosity.h"
#include "study/study.h"

int main(int argc, char** argv) {
  using namespace radiosity;
  const bool has_scene = argc > 2 && argv[1][0] != '-';  // options are for other benchmarks
  const Scene scene = io::read_scene(std::string(RADIOSITY_SCENES "/") +
                                     (has_scene ? argv[1] : "cornell-box.json"));
  const auto [mesh, visibility] =
      study::divide(scene, {.patches = {.n_patches = has_scene ? std::atol(argv[2]) : 2000}});
  // How bright the patches are makes no difference, but dark ones are passed over.
  const Eigen::MatrixXd reflectance = radiosity::reflectance(scene, mesh);
  const Eigen::MatrixXd exitance = Eigen::MatrixXd::Ones(mesh.size(), scene.bands.count());
  const int side = argc > 3 ? std::atoi(argv[3]) : 512;
  const int samples = argc > 4 ? std::atoi(argv[4]) : 16;

  const auto start = std::chrono::steady_clock::now();
  const std::clock_t start_cpu = std::clock();
  const FinalGather gather(mesh, exitance + reflectance);
  const Image image = render_gathered(gather, visibility, {exitance, reflectance},
                                      scene.camera.value_or(fit_camera(mesh)),
                                      {.width = side, .height = side, .samples = samples});
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const double cpu = static_cast<double>(std::clock() - start_cpu) / CLOCKS_PER_SEC;
  fmt::print("{} patches, {} x {} pixels: {:.2f} s, {:.2f} s of processor time, {:.1f} us/pixel\n",
             mesh.size(), side, side, seconds, cpu, 1e6 * cpu / (double(side) * side));
  return image.values.allFinite() ? 0 : 1;
}
