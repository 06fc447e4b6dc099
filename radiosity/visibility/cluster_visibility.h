#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "radiosity/visibility/blocker_set.h"
#include "radiosity/visibility/cluster_tree.h"

namespace radiosity {

/// Nodes of a BlockerSet that may block something.
using Candidates = std::vector<std::int32_t>;

/// All that blocks in a scene.
Candidates all_candidates(const BlockerSet& blockers);

/// Those of `candidates`, or of what they are made of, that may block some segment between two
/// clusters; empty optional if one of them is proved to block every segment. Between leaves of the
/// cluster tree they are leaves of the blockers' tree, too. `thickness` is how far off a plane a
/// point may be and still count as on it, m.
std::optional<Candidates> possible_blockers(const Cluster& a, const Cluster& b,
                                            const BlockerSet& blockers,
                                            std::span<const std::int32_t> candidates,
                                            double thickness);

/// Whether the patches of one cluster all lie behind those of the other.
bool are_averted(const Cluster& a, const Cluster& b, double thickness);

}  // namespace radiosity
