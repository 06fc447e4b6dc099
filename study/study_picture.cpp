#include "study/study_picture.h"

#include "radiosity/picture/gathered_picture.h"
#include "radiosity/picture/lightmap.h"

namespace study {

using namespace radiosity;

Image draw(const Study& study, const Camera& camera, Shading shading,
           const RenderOptions& options) {
  const Solution& solution = study.solution;
  if (shading == Shading::interpolated) {
    return render(study.mesh, study.visibility, solution.radiosity, camera, options);
  }
  const FinalGather gather(study.mesh, solution.radiosity);
  return render_gathered(gather, study.visibility, {solution.exitance, solution.reflectance},
                         camera, options);
}

Image draw_lightmap(const Study& study, const LightAtlas& atlas, Shading shading,
                    const RenderOptions& options) {
  const Solution& solution = study.solution;
  if (shading == Shading::interpolated) {
    return make_lightmap(study.mesh, atlas, solution.radiosity, options);
  }
  const FinalGather gather(study.mesh, solution.radiosity);
  return make_gathered_lightmap(study.mesh, atlas, gather,
                                {solution.exitance, solution.reflectance}, options);
}

}  // namespace study
