#pragma once

#include <hdf5.h>

#include <string>
#include <vector>

#include "radiosity/scene/patch_mesh.h"

/// The patches in an HDF5 file: /patches, /polygons, /surfaces and /vertices.
namespace io::hdf5 {

/// Throws HdfError.
void write_mesh(hid_t file, const radiosity::PatchMesh& mesh);

/// What write_mesh wrote, with every index checked. Of a file of before corners were stored:
/// squares of the patches' areas about their centroids, without backs, and a warning tells so.
/// Throws HdfError.
radiosity::PatchMesh read_mesh(hid_t file, std::vector<std::string>& warnings);

}  // namespace io::hdf5
