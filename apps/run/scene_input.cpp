#include "apps/run/scene_input.h"

#include <fmt/format.h>

#include "apps/terminal/output_files.h"
#include "io/scene/scene_file.h"
#include "radiosity/base/error.h"

namespace apps {

using radiosity::Scene;

Scene read_scene_warning(const CommonOptions& common, const study::StudyEvents& events) {
  Scene scene = io::read_scene(common.scene, {.unit = common.unit,
                                              .precision = common.precision,
                                              .strict = common.strict,
                                              .progress = events.progress});
  give_heat(common.heat, scene, events.progress);
  check_against_inputs(common.outputs, scene.files);
  for (const std::string& warning : scene.warnings) events.warn(warning);
  return scene;
}

Scene read_checked_scene(const CommonOptions& common, const study::StudyEvents& events) {
  Scene scene = read_scene_warning(common, events);
  if (scene.n_polygons() == 0) {
    throw radiosity::SceneError(fmt::format("{}: the scene has no polygons", common.scene));
  }
  return scene;
}

}  // namespace apps
