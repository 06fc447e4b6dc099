#pragma once

#include <filesystem>

#include "io/base/json_item.h"
#include "radiosity/scene/glazing.h"
#include "radiosity/scene/scene.h"

namespace io {

/// What a pane lets through: `transmittance` at all angles, or by its `refractive_index` with
/// `internal_transmittance` (`by_thickness`: that at normal incidence), or with `thickness` (m) and
/// `absorption` (1/m). Throws SceneError
/// naming the item.
radiosity::Glazing read_glazing(const JsonItem& item, const radiosity::Bands& bands,
                                const std::filesystem::path& folder);

/// Adds to a scene's materials the "glazing" of theirs, `materials` being what these were read
/// from.
void add_glazing(const JsonItem& materials, const std::filesystem::path& folder,
                 radiosity::Scene& scene);

}  // namespace io
