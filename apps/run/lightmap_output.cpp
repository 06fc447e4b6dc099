#include "apps/run/lightmap_output.h"

#include "apps/terminal/output_files.h"
#include "io/picture/image_file.h"
#include "io/result/lightmap_glb.h"
#include "radiosity/picture/light_atlas.h"
#include "study/study_picture.h"

namespace apps {

void write_lightmap(const study::Study& solved, const std::vector<std::string>& outputs,
                    const LightmapOptions& options, const PictureOptions& picture,
                    const radiosity::Progress& progress, Interruption& interruption) {
  const radiosity::LightAtlas atlas = radiosity::make_light_atlas(solved.mesh, options.size);
  radiosity::RenderOptions render_options = picture.render;
  render_options.progress = progress;
  const radiosity::Image lightmap = study::draw_lightmap(
      solved, atlas, picture.gather ? study::Shading::gathered : study::Shading::interpolated,
      render_options);
  progress.check();
  io::ImageOptions image_options = picture.image;
  image_options.wavelengths = solved.scene.bands.wavelengths;
  for (const std::string& output : outputs) {
    if (!is_glb(output)) continue;
    const auto lock = interruption.hold();
    io::write_lightmap_glb(output, solved.mesh, atlas, lightmap, image_options,
                           io::up_axis(solved.scene.camera));
  }
  for (const std::string& file : options.atlases) {
    const auto lock = interruption.hold();
    io::write_image(file, lightmap, image_options);
  }
}

}  // namespace apps
