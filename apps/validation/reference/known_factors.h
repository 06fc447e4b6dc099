#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "radiosity/base/geometry.h"

namespace apps::validation {

/// An entry of form-factors.json: a form factor, or a radiosity, in closed form.
struct KnownFactor {
  std::string name;
  std::string kind;
  std::vector<radiosity::Vec3> polygon1;  ///< m; empty if only described in words
  std::vector<radiosity::Vec3> polygon2;
  double exchange_area = 0;                             ///< A_1 F_12, m²; 0 if not given
  std::map<std::string, double> params{};               ///< those that are numbers
  std::map<std::string, std::vector<double>> values{};  ///< a number is a list of one

  /// A value that is one number. Throws SceneError if there is none of that name.
  [[nodiscard]] double value(const std::string& key) const;
};

/// Reads form-factors.json in the folder of reference data. Throws SceneError naming the file if it
/// is missing or not as expected.
std::vector<KnownFactor> read_known_factors(const std::filesystem::path& data);

/// The first entry whose name contains `part`. Throws SceneError if there is none.
const KnownFactor& known_factor(const std::vector<KnownFactor>& list, std::string_view part);

}  // namespace apps::validation
