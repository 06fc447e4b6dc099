#include "viewer/desk/asking.h"

#include <utility>

namespace viewer {
namespace {

void take_sums(Asking asking, PatchSums sums) {
  asking.facts->direct = std::move(sums.direct);
  asking.facts->arrivals = std::move(sums.arrivals);
  asking.facts->is_summed = true;
  asking.emitter_shares = std::move(sums.emitter_shares);
}

/// Those of the light before stay until there are new ones.
void keep_sums(PatchFacts& facts, const PatchFacts& before) {
  facts.direct = before.direct;
  facts.arrivals = before.arrivals;
  facts.is_summed = before.is_summed;
}

}  // namespace

PatchSums patch_sums(const Known& known, const LightMix& mix) {
  PatchSums sums;
  if (!known.light || !known.row) return sums;
  const radiosity::Solution& solution = known.light->solution;
  const Eigen::VectorXd& row = known.row->factors;
  sums.direct = solution.exitance.transpose() * row;
  if (known.light->mix) {
    sums.direct += outer_irradiance_at(known.model, *known.light->mix, known.row->patch);
  }
  sums.arrivals = arrivals(*known.model.mesh, row, solution.radiosity, known.model.bands);
  if (known.light_path) {
    sums.emitter_shares = emitter_shares(*known.light_path, known.model, solution, mix);
  }
  return sums;
}

bool update_asking(const Session& session, Asking asking) {
  const bool has_come = asking.summing.deliver();
  const Session::Versions& now = session.versions();
  const Session::Versions& then = asking.versions;
  if (now.light == then.light && now.selection == then.selection && now.model == then.model) {
    return has_come;
  }
  asking.versions = now;
  asking.summing.cancel();
  const std::optional<PatchFacts> before = std::exchange(asking.facts, std::nullopt);
  if (!session.selected()) {
    asking.emitter_shares.clear();
    return true;
  }
  asking.facts = patch_facts(session);
  const Known known = session.known();
  if (known.model.mesh->size() <= kManyPatches) {
    take_sums(asking, patch_sums(known, session.mix()));
    return true;
  }
  const bool is_same = before && before->patch == asking.facts->patch && now.model == then.model;
  if (is_same) keep_sums(*asking.facts, *before);
  if (!is_same || !known.light_path) asking.emitter_shares.clear();
  if (!known.light || !known.row) return true;
  asking.summing.start([asking, known, mix = session.mix()](const Worker::Context& context) {
    context.post([asking, sums = patch_sums(known, mix)] { take_sums(asking, sums); });
  });
  return true;
}

}  // namespace viewer
