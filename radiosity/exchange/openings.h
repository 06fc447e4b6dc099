#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "radiosity/scene/patch_mesh.h"
#include "radiosity/visibility/visibility.h"

namespace radiosity {

/// What of `missing`, the share of each patch's power that reaches no front (n_patches), meets the
/// backs of one-sided surfaces, which absorb it; the rest leaves the scene. Told by some 2e5
/// cosine-distributed rays, at least 16 a patch: if none of them leaves the scene, nothing does.
/// Otherwise patches that miss less than 1e-4 are not asked: theirs leaves. Deterministic for a
/// seed.
Eigen::VectorXd shares_on_backs(const PatchMesh& mesh, const Visibility& visibility,
                                const Eigen::VectorXd& missing, std::uint64_t seed);

/// The share of the light of some patches that meets no front, in [0, 1], each with its standard
/// error, by cosine-distributed rays: 2e6 in all, and 64 to 1024 a patch. Unknown (NaN) of patches
/// of which other surfaces cover a part and of slivers, where rays start in the dark or miss what
/// is close. Deterministic for a seed.
struct OpenShare {
  double share = 0;
  double error = 0;
};
std::vector<OpenShare> open_shares(const PatchMesh& mesh, const Visibility& visibility,
                                   const Eigen::VectorXd& covered,
                                   const std::vector<std::int32_t>& patches, std::uint64_t seed);

/// Whether light that leaves the patches meets fronts only, but for a share of `tolerance` of a
/// patch: then make_transport() takes the scene as closed, too, if it is to find out. Told without
/// form factors by some 2e5 rays, of large meshes from every second, third... patch, and from no
/// slivers, for rays miss what is close to their start. False without patches. Deterministic for a
/// seed.
bool is_enclosed(const PatchMesh& mesh, const Visibility& visibility, double tolerance,
                 std::uint64_t seed);

}  // namespace radiosity
