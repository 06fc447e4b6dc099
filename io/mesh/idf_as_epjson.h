#pragma once

#include <filesystem>

#include "io/base/json_item.h"
#include "radiosity/base/progress.h"

namespace io {

/// What an input file of EnergyPlus as text (.idf) says of geometry and surfaces, in the form that
/// .epJSON files have: objects by type and name, with the fields' names there. Other types are left
/// out. Reads files of before 9.6, too, in which surfaces have no space. Throws SceneError with
/// file and line for a faulty field and for a name that stands twice, in whatever case;
/// Interrupted.
Json idf_as_epjson(const std::filesystem::path& path, const radiosity::Progress& progress);

}  // namespace io
