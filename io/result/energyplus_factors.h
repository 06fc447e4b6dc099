#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

namespace io {

/// Form factors between the surfaces of zones, or of the spaces that zones are divided into.
struct ZoneFactors {
  std::vector<std::string> surfaces;  ///< their names
  std::vector<std::string> zones;     ///< the name of each one's zone
  Eigen::MatrixXd factors;            ///< F_ij, from i to j
};

/// Throws SceneError for a name that the file, if it is an .idf, cannot hold.
void check_energyplus_names(const std::filesystem::path& path, const ZoneFactors& table);

/// Writes them as EnergyPlus takes them, an object ZoneProperty:UserViewFactors:BySurfaceName for
/// each zone with all pairs of its surfaces: as text into an .idf, as JSON into an .epJSON. Factors
/// between zones are left out. Throws OutputError; SceneError for a name that an .idf cannot hold.
void write_energyplus_factors(const std::filesystem::path& path, const ZoneFactors& table);

}  // namespace io
