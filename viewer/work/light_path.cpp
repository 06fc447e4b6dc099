#include "viewer/work/light_path.h"

#include <algorithm>

namespace viewer {

std::vector<EmitterShare> emitter_shares(const LightPath& path, const radiosity::PatchMesh& mesh,
                                         const Eigen::MatrixXd& exitance, const LightMix& mix) {
  std::vector<EmitterShare> shares;
  double total = 0;
  for (std::size_t e = 0; e < mix.emitters.size(); ++e) {
    const Eigen::MatrixXd emitted = emitter_exitance(mesh, exitance, mix.emitters[e]);
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
