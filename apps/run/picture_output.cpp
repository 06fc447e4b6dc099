#include "apps/run/picture_output.h"

#include "apps/options/camera_options.h"
#include "apps/options/quantity_options.h"
#include "io/picture/false_color.h"
#include "io/picture/image_file.h"
#include "radiosity/solve/quantity.h"
#include "study/study_picture.h"

namespace apps {
namespace {

using namespace radiosity;

ShownScale write_false_color_picture(const std::string& path, const study::Study& solved,
                                     const PictureOptions& options, const Camera& camera,
                                     const RenderOptions& render_options,
                                     Interruption& interruption) {
  const QuantityField field =
      make_field(*quantity_named(*options.false_color.quantity), solved.mesh, solved.solution,
                 solved.scene.bands, options.photometry.efficacy_or_default());
  const ShownQuantity shown = shown_quantity(field, solved.scene.bands, options.false_color);
  const Image image =
      render_values(solved.mesh, solved.visibility, shown.values, camera, render_options);
  render_options.progress.check();
  study::refuse_empty(image);
  const auto lock = interruption.hold();
  const io::ColorScale scale = io::write_false_color(path, image, shown.options);
  return {std::string(field.info.name), field.unit, scale};
}

}  // namespace

std::optional<ShownScale> write_picture(const std::string& path, const study::Study& solved,
                                        const PictureOptions& options, const Progress& progress,
                                        Interruption& interruption) {
  const Camera camera = choose_camera(solved.scene, solved.mesh, options.camera).camera;
  RenderOptions render_options = options.render;
  render_options.progress = progress;
  if (options.false_color.quantity) {
    return write_false_color_picture(path, solved, options, camera, render_options, interruption);
  }
  const Image image = study::draw(
      solved, camera, options.gather ? study::Shading::gathered : study::Shading::interpolated,
      render_options);
  io::ImageOptions image_options = options.image;
  image_options.wavelengths = solved.scene.bands.wavelengths;
  const auto lock = interruption.hold();
  io::write_image(path, image, image_options);
  return std::nullopt;
}

}  // namespace apps
