#pragma once

#include <string>
#include <vector>

#include "radiosity/scene/photometry.h"
#include "study/ugr_table.h"

namespace apps {

/// The lines that `inspect` prints of a photometric file.
std::string photometry_text(const radiosity::Photometry& photometry,
                            const std::vector<std::string>& outputs);

/// The JSON object that it prints; with a UGR table, unless that is null.
std::string photometry_json(const radiosity::Photometry& photometry, const study::UgrTable* ugr,
                            const std::vector<std::string>& outputs,
                            const std::vector<std::string>& warnings);

}  // namespace apps
