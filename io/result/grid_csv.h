#pragma once

#include <filesystem>

#include "radiosity/meter/grid_light.h"

namespace io {

/// Writes a row for each point under the header x,y,z,normal_x,normal_y,normal_z,place and, for
/// each quantity Q of each light, Q,Q_direct,Q_indirect,Q_error, lux; those of a second light, of
/// maintained lamps, are called Q_maintained...: x, y, z in m; place is `open`, `inside` a solid or
/// `outside`; where it is not open what follows is empty. Numbers read back as the same double.
/// Throws OutputError.
void write_grid_csv(const std::filesystem::path& path, const radiosity::GridLight& light);

}  // namespace io
