#pragma once

#include <filesystem>
#include <vector>

#include "radiosity/scene/scenario.h"

namespace io {

/// Reads a list of scenarios (.json, docs/command-line.md): names that differ and may stand in file
/// names, factors of at least 0, reflectances in [0, 1]. Throws SceneError with file and item.
std::vector<radiosity::Scenario> read_scenarios(const std::filesystem::path& path);

}  // namespace io
