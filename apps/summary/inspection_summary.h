#pragma once

#include <string>
#include <vector>

#include "meshing/inspect/inspect.h"
#include "radiosity/scene/scene.h"

namespace apps {

/// What `inspect` found: counts and measures, the surfaces, then each finding on one line.
std::string inspect_text(const radiosity::Scene& scene, const meshing::Inspection& inspection,
                         const std::vector<std::string>& outputs);

}  // namespace apps
