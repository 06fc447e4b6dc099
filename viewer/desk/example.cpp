#include "viewer/desk/example.h"

#include <algorithm>
#include <array>
#include <system_error>

#include "io/base/extension.h"
#include "io/picture/color_map.h"
#include "io/picture/tone_mapping.h"
#include "radiosity/picture/render.h"
#include "radiosity/picture/shooting_preview.h"
#include "radiosity/scene/radiometry.h"
#include "radiosity/solve/quantity.h"
#include "radiosity/solve/surface_flux.h"
#include "radiosity/visibility/incident_light.h"
#include "study/study.h"
#include "viewer/desk/orientation.h"
#include "viewer/desk/ray_picture.h"

namespace viewer {
namespace {

namespace fs = std::filesystem;
using radiosity::Image;
using radiosity::Scene;

constexpr int kPatches = 800;
constexpr int kMostShots = 150;
constexpr double kLittleUnshot = 0.05;  // share of the emitted power
constexpr int kSamples = 4;             // rays in a pixel

/// W/m², n x b.
Eigen::MatrixXd rough_radiosity(const Scene& scene, const study::Patches& patches,
                                const radiosity::Progress& progress) {
  radiosity::ShootingPreview preview(patches.mesh, patches.visibility,
                                     radiosity::initial_radiosity(scene, patches.mesh),
                                     radiosity::reflectance(scene, patches.mesh));
  for (int k = 0; k < kMostShots && preview.unshot_share() > kLittleUnshot; ++k) {
    progress.check();
    preview.shoot();
  }
  return preview.with_ambient();
}

/// Eight bits of the pixels' colours, the background where nothing is hit.
template <typename ColorOf>
io::RgbPicture as_picture(const Image& image, const ColorOf& color_of) {
  io::RgbPicture picture{.width = image.width, .height = image.height, .bytes = {}};
  for (std::size_t i = 0; i < image.alpha.size(); ++i) {
    const float alpha = image.alpha[i];
    const io::Rgb color =
        alpha > 0 ? color_of(static_cast<Eigen::Index>(i), alpha) : kBackgroundColor;
    for (std::size_t c = 0; c < 3; ++c) {
      const float blended = alpha * static_cast<float>(color[c]) +
                            (1 - alpha) * static_cast<float>(kBackgroundColor[c]);
      picture.bytes.push_back(static_cast<std::uint8_t>(std::lround(blended)));
    }
  }
  return picture;
}

}  // namespace

std::vector<Example> find_examples(const fs::path& folder) {
  std::vector<Example> examples;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    const fs::path& path = entry->path();
    if (io::lower_case_extension(path.string()) != ".json") continue;
    examples.push_back({.path = path.string(), .name = path.stem().string(), .description = ""});
  }
  std::sort(examples.begin(), examples.end(),
            [](const Example& a, const Example& b) { return a.name < b.name; });
  return examples;
}

io::RgbPicture example_picture(const Scene& scene, const radiosity::Progress& progress) {
  study::StudyOptions options;
  options.patches.n_patches = kPatches;
  const study::Patches patches = study::divide(scene, options, {.progress = progress});
  const Eigen::MatrixXd radiosity = rough_radiosity(scene, patches, progress);
  const radiosity::Camera camera =
      scene.camera ? *scene.camera
                   : outside_camera(patches.mesh, guessed_up(patches.mesh, scene.camera));
  const radiosity::RenderOptions rendering = {
      .width = kExampleWidth, .height = kExampleHeight, .samples = kSamples, .progress = progress};
  if (radiosity::is_thermal(scene)) {
    const io::ColorScale scale = io::fitting_scale(radiosity.col(0), false);
    const Image image =
        radiosity::render_values(patches.mesh, patches.visibility, radiosity, camera, rendering);
    return as_picture(image, [&](Eigen::Index i, float alpha) {
      return io::map_color(io::position_on(scale, image.values(i, 0) / alpha));
    });
  }
  const Image image =
      radiosity::render(patches.mesh, patches.visibility, radiosity, camera, rendering);
  const Eigen::MatrixX3f colors = io::display_colors(image.values, scene.bands.wavelengths);
  const double exposure = io::automatic_exposure(colors);
  return as_picture(image, [&](Eigen::Index i, float alpha) {
    return io::srgb_bytes(colors.row(i) / alpha, exposure);
  });
}

}  // namespace viewer
