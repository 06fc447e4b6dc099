/// Prints the form factors of a few small scenes, one number a line.

#include <cstdio>

#include "radiosity/assembly/make_dense_transport.h"
#include "radiosity/assembly/transport_options.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/visibility/visibility.h"
#include "tests/support/shapes.h"

namespace {

using namespace radiosity;

void print(const PatchMesh& mesh, double tolerance) {
  const Visibility visibility(mesh);
  const auto transport =
      make_dense_transport(mesh, visibility, {.tolerance = tolerance, .closed = Closed::no});
  for (Index i = 0; i < mesh.size(); ++i) {
    for (const double factor : rows_of(*transport).row(i)) std::printf("%.17g\n", factor);
  }
}

}  // namespace

int main() {
  const PatchMesh boxes = test::box_in_box(4, 2);
  print(boxes, 1e-2);
  print(boxes, 1e-5);
  // Turned, so that no coordinate is a round number.
  const Eigen::AngleAxisd turn(0.7, Vec3(1, 2, 3).normalized());
  PatchMesh turned;
  turned.surface_names = boxes.surface_names;
  turned.surface_two_sided = boxes.surface_two_sided;
  for (const Vec3& vertex : boxes.vertices) turned.vertices.push_back(turn * vertex);
  for (Index i = 0; i < boxes.size(); ++i) {
    turned.add_patch(boxes.corners[i], boxes.surface[i], boxes.polygon[i]);
  }
  print(turned, 1e-2);
}
