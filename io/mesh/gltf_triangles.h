#pragma once

#include <cstdint>
#include <vector>

#include "io/mesh/gltf_document.h"

namespace io {

/// Whether a primitive of a glTF file is drawn as triangles of any kind, not as points or lines.
bool has_gltf_triangles(const JsonItem& primitive);

/// Number of triangles that a primitive makes of so many corners, those without area included.
std::int64_t n_gltf_triangles(const JsonItem& primitive, std::int64_t n_corners);

/// Three vertices of a primitive per triangle, counter-clockwise seen from the front, of lists,
/// strips and fans; triangles without area that join strips are left out. Throws SceneError for
/// indices of vertices that are not there.
std::vector<std::int32_t> gltf_triangles(GltfDocument& document, const JsonItem& primitive,
                                         std::int64_t n_vertices);

}  // namespace io
