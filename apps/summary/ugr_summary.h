#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "study/ugr_table.h"

namespace apps {

/// The table that `inspect --ugr-table` prints of a luminaire of so many lumens.
std::string ugr_text(const study::UgrTable& table, double flux);

/// The same for its JSON object.
nlohmann::ordered_json ugr_json(const study::UgrTable& table);

}  // namespace apps
