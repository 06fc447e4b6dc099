// Form factors of an eighth of a cube and of the cube it stands for: processor time and the largest
// difference. Usage: symmetry_bench [EDGE], default edges of 1/12 of the eighth's.
#include <fmt/format.h>

#include <cstdlib>

#include "bench/usage.h"
#include "radiosity/assembly/make_dense_transport.h"
#include "radiosity/operator/factor_rows.h"
#include "radiosity/scene/whole_mesh.h"
#include "radiosity/visibility/visibility.h"
#include "tests/support/shapes.h"

int main(int argc, char** argv) {
  using namespace radiosity;
  const int n = argc > 1 ? std::atoi(argv[1]) : 12;
  PatchMesh part;
  test::add_grid(part, Vec3(1, 0, 0), Vec3(0, 0, 1), Vec3(0, 1, 0), n, n);
  test::add_grid(part, Vec3(0, 1, 0), Vec3(1, 0, 0), Vec3(0, 0, 1), n, n);
  test::add_grid(part, Vec3(0, 0, 1), Vec3(0, 1, 0), Vec3(1, 0, 0), n, n);
  Symmetry symmetry;
  for (int axis = 0; axis < 3; ++axis) symmetry.mirrors.push_back({Vec3::Zero(), Vec3::Unit(axis)});
  part.images = image_motions(symmetry);
  const auto measured = [](const char* name, const PatchMesh& mesh) {
    const double start = bench::processor_seconds();
    auto transport = make_dense_transport(mesh, Visibility(mesh), {.closed = Closed::no});
    fmt::print("{:6} {:6} patches {:8.2f} s of processors {:10} bytes\n", name, mesh.size(),
               bench::processor_seconds() - start, transport->bytes());
    return transport;
  };
  const auto of_part = measured("part", part);
  const PatchMesh whole = make_whole(part);
  const auto of_whole = measured("whole", whole);
  const Eigen::VectorXd row = rows_of(*of_whole).row(0);
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(part.size());
  for (Index g = 0; g < row.size(); g += part.size()) sum += row.segment(g, part.size());
  fmt::print("largest difference in a row {:.2g}\n",
             (rows_of(*of_part).row(0) - sum).cwiseAbs().maxCoeff());
}
