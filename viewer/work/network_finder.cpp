#include "viewer/work/network_finder.h"

#include <utility>

#include "radiosity/base/error.h"
#include "radiosity/scene/radiometry.h"

namespace viewer {

using radiosity::Index;

Eigen::VectorXd exchange_emissivity(const radiosity::Scene& scene,
                                    const radiosity::PatchMesh& mesh) {
  const Eigen::MatrixXd all = radiosity::emissivity(scene, mesh);
  if (scene.bands.kind == radiosity::Bands::Kind::solar_infrared) return all.col(1);
  for (Index band = 1; band < all.cols(); ++band) {
    if (all.col(band) != all.col(0)) {
      throw radiosity::SceneError(
          "couplings are those of one band, and surfaces emit differently in the scene's bands");
    }
  }
  return all.col(0);
}

void NetworkFinder::reset() {
  worker_.cancel();
  of_.reset();
  network_.reset();
  is_wanted_ = false;
}

bool NetworkFinder::update(Session& session) {
  bool has_changed = worker_.deliver();
  if (const auto error = worker_.take_error()) {
    session.tell_error(*error);
    has_changed = true;
  }
  const Model& model = session.model();
  const bool is_same = of_ == model.transport && mix_.has_reflectance_of(session.mix());
  if (of_ && !is_same) {
    worker_.cancel();
    of_.reset();
    network_.reset();
    has_changed = true;
  }
  if (!is_wanted_ || of_ || !model.transport || !session.is_thermal()) return has_changed;
  of_ = model.transport;
  mix_ = session.mix();
  worker_.start([this, model, mix = mix_](const Worker::Context& context) {
    const radiosity::Scene scene = with_reflectance(*model.scene, mix);
    auto network = std::make_shared<const radiosity::ExchangeNetwork>(radiosity::exchange_network(
        *model.transport, exchange_emissivity(scene, *model.mesh), model.mesh->surface,
        static_cast<Index>(model.mesh->surface_names.size()), {.progress = context.progress}));
    context.post([this, network] { network_ = network; });
  });
  return true;
}

}  // namespace viewer
