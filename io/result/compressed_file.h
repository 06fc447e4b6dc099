#pragma once

#include <hdf5.h>

#include <memory>

#include "radiosity/compressed/compressed_transport.h"
#include "radiosity/scene/patch_mesh.h"

/// A compressed operator in an HDF5 file: /compressed, and how it was made (write_report).
namespace io::hdf5 {

/// Whether the file holds one.
bool has_compressed(hid_t file);

/// Throws HdfError.
void write_compressed(hid_t file, const radiosity::CompressedTransport& transport);

/// What write_compressed wrote of the patches of `mesh`, with every size and index checked. Throws
/// HdfError.
std::unique_ptr<radiosity::CompressedTransport> read_compressed(hid_t file,
                                                                const radiosity::PatchMesh& mesh);

}  // namespace io::hdf5
