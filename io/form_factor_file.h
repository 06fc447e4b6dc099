#pragma once

#include <filesystem>

#include "radiosity/patch_mesh.h"
#include "radiosity/progress.h"
#include "radiosity/transport.h"

namespace io {

struct FormFactorFileOptions {
  double tolerance = 1e-3;  ///< the relative error that was asked for, stored as an attribute
  radiosity::Progress progress{};
};

/// Writes form factors to an HDF5 file: /form_factors/{data,indices,indptr}, the CSR form of F
/// (float64, int64), so that scipy.sparse.csr_matrix((data, indices, indptr)) works as it is;
/// /form_factors/error, one sigma of each entry; /patches/{area,centroid,normal,surface,polygon};
/// /surfaces/name; /closure, the raw row sums before any correction; attributes tolerance, closed,
/// version. Rows are written one after the other, so that memory stays small. Written beside and
/// renamed into place. Throws OutputError (a full disk, say), Interrupted.
void write_form_factors(const std::filesystem::path& path, const radiosity::PatchMesh& mesh,
                        const radiosity::Transport& transport,
                        const FormFactorFileOptions& options = {});

}  // namespace io
