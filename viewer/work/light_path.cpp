#include "viewer/work/light_path.h"

#include <algorithm>

namespace viewer {

namespace {

/// What leaves the patches of one emitter's light before any of it is exchanged, W/m², n x b.
Eigen::MatrixXd first_radiosity(const Model& model, const radiosity::Solution& solution,
                                const LightMix& mix, std::size_t e) {
  const Emitter& emitter = mix.emitters[e];
  if (emitter.kind == Emitter::Kind::surfaces) {
    return emitter_exitance(*model.mesh, solution.exitance, emitter);
  }
  if (!model.outer)
    return Eigen::MatrixXd::Zero(solution.reflectance.rows(), solution.reflectance.cols());
  return emitter.factor() * solution.reflectance.cwiseProduct(*model.outer->irradiance[e]);
}

}  // namespace

std::vector<EmitterShare> emitter_shares(const LightPath& path, const Model& model,
                                         const radiosity::Solution& solution, const LightMix& mix) {
  std::vector<EmitterShare> shares;
  double total = 0;
  for (std::size_t e = 0; e < mix.emitters.size(); ++e) {
    const Eigen::MatrixXd emitted = first_radiosity(model, solution, mix, e);
    EmitterShare share;
    share.emitter = e;
    share.radiosity = path.importance.cwiseProduct(emitted).colwise().sum();
    share.share = share.radiosity.sum();
    total += share.share;
    shares.push_back(std::move(share));
  }
  for (EmitterShare& share : shares) share.share = total > 0 ? share.share / total : 0;
  std::sort(shares.begin(), shares.end(),
            [](const EmitterShare& a, const EmitterShare& b) { return a.share > b.share; });
  return shares;
}

}  // namespace viewer
