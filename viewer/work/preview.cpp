#include "viewer/work/preview.h"

#include <chrono>
#include <utility>

#include "radiosity/picture/shooting_preview.h"
#include "radiosity/scene/radiometry.h"
#include "viewer/work/pipeline.h"
#include "viewer/work/worker.h"

namespace viewer {
namespace {

using radiosity::Progress;
using radiosity::Solution;
using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

constexpr Seconds kHurry(3);            // in which it takes what time it can get
constexpr double kInterval = 0.08;      // between pictures, s
constexpr double kRest = 3;             // times as long as it worked, after the hurry
constexpr double kLittleUnshot = 0.01;  // share of the emitted power at which a preview ends

/// Radiosity before any iteration as a solution, to be shown. Errors are left empty.
Solution preview_solution(Eigen::MatrixXd radiosity, const Eigen::MatrixXd& exitance,
                          const Eigen::MatrixXd& reflectance) {
  Solution solution;
  // H = (B - M) / ρ; where nothing is reflected it is not known.
  solution.irradiance = (reflectance.array() > 0)
                            .select((radiosity - exitance).array() / reflectance.array(), 0)
                            .matrix();
  solution.radiosity = std::move(radiosity);
  solution.exitance = exitance;
  solution.reflectance = reflectance;
  return solution;
}

}  // namespace

void preview(const Model& before, const LightMix& mix, const Previewed& previewed,
             const Progress& progress) {
  const Model model = below_sky(before, mix, progress);
  const radiosity::Scene scene = with_reflectance(*model.scene, mix);
  const Eigen::MatrixXd emitted = mix_exitance(scene, *model.mesh, mix);
  const Eigen::MatrixXd reflectance = radiosity::reflectance(scene, *model.mesh);
  // Heat that is taken away is no light to shoot.
  const Eigen::MatrixXd initial =
      radiosity::initial_radiosity(emitted.cwiseMax(0), reflectance, outer_irradiance(model, mix));
  radiosity::ShootingPreview shooting(*model.mesh, *model.visibility, initial, reflectance);
  const auto start = Clock::now();
  do {
    const auto begun = Clock::now();
    shooting.shoot(kInterval, progress);
    previewed(preview_solution(shooting.with_ambient(), emitted, reflectance), model.outer,
              shooting.unshot_share());
    progress.check();
    const auto now = Clock::now();
    if (now - start > kHurry) rest(kRest * (now - begun), progress.stop);
  } while (shooting.unshot_share() > kLittleUnshot);
}

}  // namespace viewer
