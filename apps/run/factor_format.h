#pragma once

#include <string>
#include <vector>

namespace apps {

/// What a file of form factors is for.
enum class FactorFormat {
  hdf5,
  table,         ///< .csv, or .txt as View3D has it; between surfaces
  moose,         ///< .csv as MOOSE has it; between surfaces
  energyplus,    ///< .idf or .epJSON; between the surfaces of a zone
  elmer,         ///< .dat; between polygons
  elmer_binary,  ///< likewise
  openfoam       ///< the file F of a case; between its faces
};

/// The names that --format takes.
const std::vector<std::string>& factor_format_names();

/// For the command line's check: empty if a file of this name can be written, else what was found
/// and expected.
std::string check_factor_output(const std::string& path);

/// What an output is, by its name and, where that leaves a choice, by --format (may be empty).
FactorFormat factor_format(const std::string& path, const std::string& asked);

/// Whether it is between polygons, whose rows are written one after the other.
bool is_by_polygon(FactorFormat format);

/// Whether it is a table between surfaces.
bool is_table(FactorFormat format);

/// Whether it is the file F of a case of OpenFOAM.
bool is_foam_file(const std::string& path);

}  // namespace apps
