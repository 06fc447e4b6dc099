#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "radiosity/base/progress.h"

namespace io {

/// An object of an input file of EnergyPlus as text (.idf): `Zone, Office, 0, 0, 0, 0;`.
struct IdfObject {
  std::string type;                 ///< as it stands: "BuildingSurface:Detailed"
  std::vector<std::string> fields;  ///< without blanks at both ends; may be empty
  long line = 0;                    ///< where it begins
};

/// In lower case, as EnergyPlus compares names.
std::string folded(std::string_view text);

/// All objects, in their order. What follows a `!` on a line is comment. Throws SceneError with
/// file and line if the last object has no end, or if a line is a macro (##); Interrupted.
std::vector<IdfObject> read_idf_objects(const std::filesystem::path& path,
                                        const radiosity::Progress& progress);

}  // namespace io
