#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "viewer/desk/patch_facts.h"
#include "viewer/work/arrivals.h"
#include "viewer/work/known.h"
#include "viewer/work/light_mix.h"
#include "viewer/work/light_path.h"
#include "viewer/work/session.h"
#include "viewer/work/worker.h"

namespace viewer {

/// What is told of the selected patch: parts of the desk, which owns them.
struct Asking {
  std::optional<PatchFacts>& facts;
  std::vector<EmitterShare>& emitter_shares;
  Session::Versions& versions;  ///< at which these were found
  Worker& summing;              ///< ends before the others do
};

/// What is summed up over all patches about the selected one.
struct PatchSums {
  Eigen::VectorXd direct;                    ///< irradiance straight from emitters, W/m², per band
  std::vector<Arrival> arrivals;             ///< by surface
  std::vector<EmitterShare> emitter_shares;  ///< empty unless the light path is known
};

/// Of the selected patch, as far as its light, its row and its light path are known. Takes as many
/// additions as there are patches, for each emitter.
PatchSums patch_sums(const Known& known, const LightMix& mix);

/// Keeps what is told of the selected patch in step with what is known: its sums at once or, of
/// very many patches, a moment later, until when those of the light before stay. Whether anything
/// changed.
bool update_asking(const Session& session, Asking asking);

}  // namespace viewer
