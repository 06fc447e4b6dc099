// Form factors of parts of symmetric wholes and of the wholes: processor time, memory, and the
// largest difference of a row, of exact pairs. Usage: symmetry_bench [N], patches along an edge,
// default 4, with which all wholes have entries of double precision.
#include <fmt/format.h>

#include <cstdlib>
#include <memory>

#include "bench/usage.h"
#include "radiosity/assembly/make_dense_transport.h"
#include "radiosity/operator/factor_rows.h"
#include "radiosity/scene/whole_mesh.h"
#include "radiosity/visibility/visibility.h"
#include "tests/support/symmetric_parts.h"

namespace {

using namespace radiosity;

struct Made {
  std::unique_ptr<Transport> transport;
  double seconds = 0;
};

Made make(const PatchMesh& mesh) {
  const double start = bench::processor_seconds();
  Made made{
      make_dense_transport(mesh, Visibility(mesh), {.tolerance = 1e-7, .closed = Closed::no})};
  made.seconds = bench::processor_seconds() - start;
  return made;
}

void compare(const char* name, const PatchMesh& mesh, const Symmetry& symmetry) {
  const PatchMesh part = test::part_of(mesh, symmetry, {});
  const PatchMesh whole = make_whole(part);
  const Made of_part = make(part);
  const Made of_whole = make(whole);
  const Eigen::VectorXd row = rows_of(*of_whole.transport).row(0);
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(part.size());
  for (Index g = 0; g < row.size(); g += part.size()) sum += row.segment(g, part.size());
  fmt::print(
      "{:18} {:5} of {:6} patches {:7.2f} of {:7.2f} s of processors: {:5.1f} %, {:9} of {:11} "
      "bytes, {:.1g} off\n",
      name, part.size(), whole.size(), of_part.seconds, of_whole.seconds,
      100 * of_part.seconds / of_whole.seconds, of_part.transport->bytes(),
      of_whole.transport->bytes(),
      (rows_of(*of_part.transport).row(0) - sum).cwiseAbs().maxCoeff());
}

}  // namespace

int main(int argc, char** argv) {
  const int n = argc > 1 ? std::atoi(argv[1]) : 4;
  compare("eighth of a cube", test::cube_corner(n), test::three_mirrors());
  compare("cylinders' sector", test::prism_sector(24, 0.4, 1, 2, 2 * n), test::folds_about_z(24));
  Symmetry sphere = test::folds_about_z(24);
  sphere.mirrors = {test::mirror(Vec3::UnitZ())};
  compare("spheres' sector", test::sphere_sector(24, n, 0.4, 1), sphere);
  Symmetry street;
  street.translations = {{Vec3(0, 0.25, 0), 10}};
  compare("canyon's period", test::canyon_period(2 * n, 0.25), street);
}
