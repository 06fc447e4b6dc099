#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "radiosity/base/geometry.h"
#include "viewer/work/arrivals.h"
#include "viewer/work/session.h"

namespace viewer {

/// What is known of one patch. Radiometric values have one entry per band, W/m².
struct PatchFacts {
  radiosity::Index patch = -1;
  std::string surface;
  std::string material;  ///< empty if there is no scene
  std::int32_t polygon = -1;
  double area = 0;  ///< m²
  radiosity::Vec3 centroid = radiosity::Vec3::Zero();
  radiosity::Vec3 normal = radiosity::Vec3::Zero();

  bool has_light = false;
  Eigen::VectorXd radiosity;
  Eigen::VectorXd irradiance;
  Eigen::VectorXd exitance;
  Eigen::VectorXd reflectance;
  Eigen::VectorXd error;   ///< one standard error of the radiosity; empty if not known (yet)
  Eigen::VectorXd direct;  ///< irradiance straight from emitters; empty until it is summed up
  double illuminance = 0;  ///< lux
  double luminance = 0;    ///< cd/m²
  std::optional<double> temperature = {};  ///< K, of what radiates by it

  bool has_factors = false;       ///< its row is there
  std::vector<Partner> partners;  ///< the ten largest form factors, the largest first
  std::vector<Arrival> arrivals;  ///< by surface; empty without light, or until summed up
  bool is_summed = false;         ///< `direct` and `arrivals` are known (`update_asking`)
  double row_sum = 0;  ///< Σ_j F_ij; what is missing to 1 leaves the scene or meets backs
};

/// Of the selected patch, which there must be, without what takes sums over all patches.
PatchFacts patch_facts(const Session& session);

/// The patch of another division of the same scene that is nearest to where the facts' patch was;
/// empty if its polygon has none.
std::optional<radiosity::Index> same_place(const radiosity::PatchMesh& mesh,
                                           const PatchFacts& facts);

/// Digits that are shown of a value, and of one that is no more than a preview.
inline constexpr int kDigits = 4;
inline constexpr int kRoughDigits = 2;

/// A value in so many digits, without a power of ten between 1e-3 and 1e6.
std::string number_text(double value, int digits = kDigits);
/// Values in few digits, for a person: "0.532  0.41  0.2"; of many their range. `is_rough` ones get
/// two digits and a mark.
std::string numbers_text(const Eigen::VectorXd& values, bool is_rough = false);
/// The same of errors, of which more than two digits mean nothing.
std::string errors_text(const Eigen::VectorXd& errors);

}  // namespace viewer
