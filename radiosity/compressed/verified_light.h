#pragma once

#include <Eigen/Core>
#include <optional>

#include "radiosity/assembly/transport_options.h"
#include "radiosity/operator/transport.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/visibility/visibility.h"

namespace radiosity {

/// What a compressed operator was found to be worth for one light.
struct VerifiedLight {
  /// What F B is off by: root of the mean square over all area, relative to that of F B, for the
  /// worst column. With 95 % confidence it is no more.
  double error = 0;
  Index n_rows = 0;  ///< that were evaluated anew to tell
};

/// Checks a compressed operator for other light than it was made for, by rows that are evaluated
/// anew: 96, and more where these do not tell whether it is within `options.tolerance`. `radiosity`
/// is n x k, at least 0. Nothing of operators that are not compressed. `options` are those that it
/// was made with. Takes what preparing the assembly takes, and a second or so for 100,000 patches.
/// Throws Interrupted.
std::optional<VerifiedLight> verify_light(const Transport& transport, const PatchMesh& mesh,
                                          const Visibility& visibility,
                                          const TransportOptions& options,
                                          const Eigen::MatrixXd& radiosity);

}  // namespace radiosity
