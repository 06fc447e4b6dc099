#pragma once

#include <Eigen/Core>

#include "radiosity/scene/patch_mesh.h"
#include "radiosity/scene/symmetry.h"

namespace radiosity {

/// What is lost beyond the cut-off of translations: for each patch a bound of the share of its
/// power that goes further than the images reckoned with, n. All images lie in a prism that goes on
/// along the translations; whatever is further is seen through the prism's ends, past the last
/// images: the bound is the form factor to these, with nothing between. 0 without translations.
Eigen::VectorXd cut_off_bound(const PatchMesh& part, const Symmetry& symmetry);

}  // namespace radiosity
