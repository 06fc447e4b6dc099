#include "apps/run/picture_check.h"

#include <fmt/format.h>

#include "radiosity/base/error.h"
#include "radiosity/base/machine_memory.h"
#include "radiosity/picture/camera_view.h"
#include "study/study_picture.h"

namespace apps {
namespace {

using radiosity::Camera;
using radiosity::Vec3;

// Share of all directions in which a point sees backs first, from which on it counts as inside a
// solid: below the 5/6 in the middle of a cube that has no bottom, or one that coincides with the
// floor, and above the 3/4 in a corner outside an L-shaped room.
constexpr double kInside = 0.8;

std::string point_text(const Vec3& p) {
  return fmt::format("({:.4g}, {:.4g}, {:.4g})", p.x(), p.y(), p.z());
}

/// The values of all pixels are kept in memory.
void refuse_too_large_picture(const PictureOptions& options, radiosity::Index n_bands) {
  const double pixels = static_cast<double>(options.render.width) * options.render.height;
  const double shown = options.false_color.quantity ? 1 : static_cast<double>(n_bands);
  constexpr double kColors = 5;  // coverage, linear RGB and bytes
  const double bytes = pixels * (shown + kColors) * sizeof(float);
  const auto memory = static_cast<double>(radiosity::usable_memory());
  if (memory == 0 || bytes <= memory) return;  // 0: unknown
  throw radiosity::SolveError(fmt::format(
      "a picture of {} x {} pixels in {} bands needs {:.1f} GB of memory, but there are "
      "{:.1f} GB",
      options.render.width, options.render.height, shown, bytes * 1e-9, memory * 1e-9));
}

void warn_inside_solid(const study::Patches& patches, const Camera& camera,
                       TerminalProgress& terminal) {
  const auto around = radiosity::surroundings(patches.visibility, camera.position);
  if (around.backs < kInside) return;
  const std::string& nearest = patches.mesh.surface_names[patches.mesh.surface[around.nearest]];
  terminal.warn(
      fmt::format("the camera at {} m is inside a solid or a wall: backs of one-sided surfaces are "
                  "all around it, nearest '{}'; the picture looks through them",
                  point_text(camera.position), nearest));
}

}  // namespace

void check_picture(const radiosity::Scene& scene, const study::Patches& patches,
                   const PictureOptions& options, TerminalProgress& terminal) {
  check_band(options.false_color, scene.bands);
  refuse_too_large_picture(options, scene.bands.count());
  const auto [camera, is_placed] = choose_camera(scene, patches.mesh, options.camera);
  const double aspect = static_cast<double>(options.render.width) / options.render.height;
  study::refuse_empty_view(scene, patches.mesh, camera, aspect);
  if (is_placed) {
    warn_inside_solid(patches, camera, terminal);
  } else {
    terminal.warn(fmt::format(
        "the scene has no camera: the picture is taken from {} m, where all of it is in "
        "view",
        point_text(camera.position)));
  }
}

}  // namespace apps
