#include "study/study_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "radiosity/base/error.h"
#include "radiosity/picture/camera_view.h"
#include "radiosity/picture/gathered_picture.h"
#include "radiosity/picture/lightmap.h"

namespace study {

using namespace radiosity;

namespace {

std::string vector_text(const Vec3& v) {
  return fmt::format("({:.4g}, {:.4g}, {:.4g})", v.x(), v.y(), v.z());
}

/// What patches send out of their own, and what shields pass on from their other side, W/m², n x b.
Eigen::MatrixXd own_light(const Solution& solution) {
  if (solution.transmission.nonZeros() == 0) return solution.exitance;
  return solution.exitance + solution.transmission * solution.irradiance;
}

}  // namespace

void refuse_empty_view(const Scene& scene, const PatchMesh& mesh, const Camera& camera,
                       double aspect) {
  const ViewContent content = view_content(mesh, camera, aspect);
  if (content.fronts) return;
  const std::string where = vector_text(camera.position);
  if (content.backs) {
    throw SceneError(
        fmt::format("{}: the picture would be empty: from {} m in direction {} the camera has only "
                    "backs of one-sided surfaces before it, which are not drawn",
                    scene.source, where, vector_text(camera.direction)));
  }
  const Box3 box = bounds(mesh);
  throw SceneError(
      fmt::format("{}: the picture would be empty: the camera at {} m looks in direction {}, past "
                  "the scene, which lies between {} and {} m",
                  scene.source, where, vector_text(camera.direction), vector_text(box.min()),
                  vector_text(box.max())));
}

void refuse_empty(const Image& image) {
  if (std::all_of(image.alpha.begin(), image.alpha.end(), [](float a) { return a == 0; })) {
    throw SceneError(
        "the picture would be empty: what the camera sees is smaller than a pixel; come closer, or "
        "use more pixels or --samples");
  }
}

Image draw(const Study& study, const Camera& camera, Shading shading,
           const RenderOptions& options) {
  refuse_empty_view(study.scene, study.mesh, camera,
                    static_cast<double>(options.width) / options.height);
  const Solution& solution = study.solution;
  Image image;
  const TextureMap textures(study.scene, study.mesh);
  if (shading == Shading::interpolated && textures.is_empty()) {
    image = render(study.mesh, study.visibility, solution.radiosity, camera, options);
  } else if (shading == Shading::interpolated) {
    image = render_textured(study.mesh, study.visibility, solution.radiosity, own_light(solution),
                            solution.irradiance, textures, camera, options);
  } else {
    const FinalGather gather(study.mesh, solution.radiosity, {study.scene, study.mesh});
    image = render_gathered(gather, study.visibility,
                            {own_light(solution), solution.reflectance, textures}, camera, options);
  }
  options.progress.check();
  refuse_empty(image);
  return image;
}

Image draw_lightmap(const Study& study, const LightAtlas& atlas, Shading shading,
                    const RenderOptions& options) {
  const Solution& solution = study.solution;
  if (shading == Shading::interpolated) {
    return make_lightmap(study.mesh, atlas, solution.radiosity, options);
  }
  const FinalGather gather(study.mesh, solution.radiosity, {study.scene, study.mesh});
  return make_gathered_lightmap(study.mesh, atlas, gather,
                                {own_light(solution), solution.reflectance}, options);
}

}  // namespace study
