#include "viewer/work/model.h"

namespace viewer {

Eigen::MatrixXd outer_irradiance(const Model& model, const LightMix& mix) {
  return model.outer ? mixed_irradiance(*model.outer, mix) : Eigen::MatrixXd();
}

Eigen::VectorXd outer_irradiance_at(const Model& model, const LightMix& mix,
                                    radiosity::Index patch) {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(model.bands.count());
  if (!model.outer) return sum;
  for (std::size_t e = 0; e < mix.emitters.size(); ++e) {
    const auto& irradiance = model.outer->irradiance[e];
    if (irradiance) sum += mix.emitters[e].factor() * irradiance->row(patch).transpose();
  }
  return sum;
}

}  // namespace viewer
