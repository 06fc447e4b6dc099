#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "radiosity/blocker.h"
#include "radiosity/cluster_tree.h"

namespace radiosity {

/// Indices of blockers that may block something.
using Candidates = std::vector<std::int32_t>;

/// Those of `candidates` that may block some segment between two clusters; empty optional if one of
/// them is proved to block every segment. `thickness` is how far off a plane a point may be and
/// still count as on it, m.
std::optional<Candidates> possible_blockers(const Cluster& a, const Cluster& b,
                                            const std::vector<Blocker>& blockers,
                                            std::span<const std::int32_t> candidates,
                                            double thickness);

/// Whether the patches of one cluster all lie behind those of the other.
bool are_averted(const Cluster& a, const Cluster& b, double thickness);

}  // namespace radiosity
