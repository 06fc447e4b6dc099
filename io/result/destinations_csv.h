#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "radiosity/exchange/sampled_destinations.h"

namespace io {

/// Writes shares as destination,surface,factor,error: a row per surface (destination "surface"),
/// then "backs" and "sky", whose surface is empty. Numbers read back as the same double. Throws
/// OutputError.
void write_destinations_csv(const std::filesystem::path& path,
                            const std::vector<std::string>& surface_names,
                            const radiosity::DestinationEstimate& shares);

}  // namespace io
