#include "viewer/desk/asking.h"

#include <utility>

#include "viewer/desk/desk.h"

namespace viewer {
namespace {

void take_sums(Desk& desk, PatchSums sums) {
  desk.facts->direct = std::move(sums.direct);
  desk.facts->arrivals = std::move(sums.arrivals);
  desk.facts->is_summed = true;
  desk.emitter_shares = std::move(sums.emitter_shares);
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

bool update_asking(Desk& desk) {
  const bool has_come = desk.summing.deliver();
  const Session& session = desk.session;
  const Session::Versions& now = session.versions();
  const Session::Versions& then = desk.facts_versions;
  if (now.light == then.light && now.selection == then.selection && now.model == then.model) {
    return has_come;
  }
  desk.facts_versions = now;
  desk.summing.cancel();
  const std::optional<PatchFacts> before = std::exchange(desk.facts, std::nullopt);
  if (!session.selected()) {
    desk.emitter_shares.clear();
    return true;
  }
  desk.facts = patch_facts(session);
  const Known known = session.known();
  if (known.model.mesh->size() <= kManyPatches) {
    take_sums(desk, patch_sums(known, session.mix()));
    return true;
  }
  const bool is_same = before && before->patch == desk.facts->patch && now.model == then.model;
  if (is_same) keep_sums(*desk.facts, *before);
  if (!is_same || !known.light_path) desk.emitter_shares.clear();
  if (!known.light || !known.row) return true;
  desk.summing.start([&desk, known, mix = session.mix()](const Worker::Context& context) {
    context.post([&desk, sums = patch_sums(known, mix)] { take_sums(desk, sums); });
  });
  return true;
}

}  // namespace viewer
