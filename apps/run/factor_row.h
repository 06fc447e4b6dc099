#pragma once

#include <string>
#include <vector>

#include "apps/options/common_options.h"
#include "radiosity/operator/joint_row.h"
#include "radiosity/scene/patch_mesh.h"
#include "study/study.h"

namespace apps {

/// What `form-factors --row` asks for.
struct RowRequest {
  std::string row;        ///< a surface's name or a patch's number
  bool is_exact = false;  ///< evaluated anew, whatever a file has
};

/// The form factors from one patch or surface to each patch.
struct FactorRow {
  std::string row;  ///< as the user gave it
  radiosity::PatchMesh mesh;
  std::vector<std::int32_t> patches;  ///< that the row is of
  radiosity::JointRow values;
  bool is_evaluated = false;  ///< one by one, not read from a file
};

/// What of the row reaches each surface, and one standard error of it, n_surfaces each.
radiosity::JointRow by_surface(const FactorRow& row);

/// Reads the row from a form-factor or operator file, or evaluates it, of a scene or of the file's
/// patches. Throws as patches_named, study::divide and the readers do.
FactorRow find_factor_row(const RowRequest& request, const CommonOptions& common,
                          const study::StudyOptions& compute, const study::StudyEvents& events);

}  // namespace apps
