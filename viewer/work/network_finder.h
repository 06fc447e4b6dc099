#pragma once

#include <memory>
#include <optional>
#include <string>

#include "radiosity/solve/exchange_network.h"
#include "viewer/work/session.h"
#include "viewer/work/worker.h"

namespace viewer {

/// Finds the exchange network between the surfaces of a thermal scene in the background, once it is
/// wanted and there are form factors; anew for other patches or reflectances.
class NetworkFinder {
 public:
  void set_wanted(bool is_wanted) { is_wanted_ = is_wanted; }
  [[nodiscard]] bool is_wanted() const { return is_wanted_; }
  /// Forgets all: it was about another scene.
  void reset();

  /// Takes in what was found and begins what is to be found. Whether there was anything.
  bool update(Session& session);
  /// Of the scene as it is now, a node for each surface of the mesh; null until it is found.
  [[nodiscard]] const radiosity::ExchangeNetwork* network() const { return network_.get(); }
  [[nodiscard]] bool is_busy() const { return worker_.is_busy(); }

 private:
  bool is_wanted_ = false;
  std::shared_ptr<const radiosity::Transport> of_;  // whose network was begun last
  LightMix mix_;                                    // with what reflectances
  std::shared_ptr<const radiosity::ExchangeNetwork> network_;
  Worker worker_;  // last, so that it ends first
};

/// The emissivity of each patch in the band that surfaces exchange heat in, n: the one band, the
/// infrared, or any of several that are alike. Throws SceneError if they differ.
Eigen::VectorXd exchange_emissivity(const radiosity::Scene& scene,
                                    const radiosity::PatchMesh& mesh);

}  // namespace viewer
