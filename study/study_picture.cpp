#include "study/study_picture.h"

#include "radiosity/picture/gathered_picture.h"

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

}  // namespace study
