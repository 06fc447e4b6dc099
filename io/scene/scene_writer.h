#pragma once

#include <filesystem>

#include "radiosity/scene/scene.h"

namespace io {

/// Writes a scene in our JSON format (docs/scene-format.md), in metres and all in the one file.
/// What `read_scene` makes of it has the same numbers, to the last bit (but `up` gets unit length,
/// and few angles of view lose that bit), and the same polygons, materials and surfaces in the same
/// order, but for this:
///  - the polygons of a surface follow each other, surface by surface, with vertices of their own
///    that are shared within the surface only;
///  - surfaces without polygons and vertices without use are left out;
///  - names (of views, too) that are empty or stand twice are made up or get "-2", "-3"..., and
///    bytes in them that are not UTF-8 are replaced;
///  - `source` and `warnings` are not stored.
/// `scene` is as valid as if it had been read. Written beside and renamed into place. Throws
/// OutputError.
void write_scene(const std::filesystem::path& path, const radiosity::Scene& scene);

}  // namespace io
