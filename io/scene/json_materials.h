#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "io/base/json_item.h"
#include "radiosity/scene/scene.h"

namespace io {

/// Reads the `materials` of a JSON scene: an object keyed by name, or a list of objects with a
/// `name`. CSV files are looked for relative to `folder`. Throws SceneError naming the item.
std::vector<radiosity::Material> read_materials(const JsonItem& materials,
                                                const radiosity::Bands& bands,
                                                const std::filesystem::path& folder);

/// What "environment" says: one of radiance, exitance and temperature.
radiosity::Emission read_environment(const JsonItem& item, const radiosity::Bands& bands,
                                     const std::filesystem::path& folder);

/// What is odd about the temperatures: that all look like degrees Celsius.
std::optional<std::string> temperature_warning(const radiosity::Scene& scene);

/// One value per band, all finite and at least 0, as emissions have them: a number for all bands, a
/// list, or a column of a CSV file. `name` is what messages call it.
Eigen::VectorXd read_band_values(const JsonItem& item, const std::string& name,
                                 const radiosity::Bands& bands,
                                 const std::filesystem::path& folder);

/// One value per band in [0, 1], as reflectances have them.
Eigen::VectorXd read_reflectances(const JsonItem& item, const radiosity::Bands& bands,
                                  const std::filesystem::path& folder);

}  // namespace io
