#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "radiosity/base/progress.h"
#include "radiosity/operator/transport.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/stream/row_stream.h"

namespace io {

/// Version of the layout, to be raised when an older reader would misread it.
inline constexpr std::int64_t kFormFactorVersion = 1;

/// Form factors as a file takes them: row by row.
struct FormFactorRows {
  const radiosity::AssemblyReport& report;
  /// Visits all rows, 0 to n - 1.
  std::function<void(const radiosity::RowVisitor&)> visit;
  /// Σ_j F_ij, n, where rounding has moved those of the rows; absent: they are as they are.
  std::optional<Eigen::VectorXd> sums = {};
};

struct FormFactorFileOptions {
  double tolerance = 1e-3;    ///< the relative error that was asked for, stored as an attribute
  double min_factor = 0;      ///< below it pairs were dropped (0 = none); likewise
  std::string fingerprint{};  ///< of the computation (radiosity::stream_fingerprint); likewise
  /// Of the scene's surfaces, so that the form factors are not used for others; likewise.
  std::string geometry{};
};

/// Writes form factors to an HDF5 file: /form_factors/{data,indices,indptr}, the CSR form of F
/// (float64, int64), so that scipy.sparse.csr_matrix((data, indices, indptr)) works as it is;
/// /form_factors/error, one sigma of each entry; /patches/{area,centroid,normal,surface,polygon,
/// corners,twin,family} (corners: n x 4 indices into /vertices, the last one -1 for a triangle;
/// twin: -1 or the patch that is the back); /vertices, m x 3, m; /polygons/{corners,first_corner};
/// /surfaces/{name,two_sided}; /closure, the raw row sums before any correction; /row_sums, those
/// after, if not the rows'; /covered, /backs, /pairs (radiosity::AssemblyReport); attributes
/// tolerance, min_factor, closed, open_rows, precision, fingerprint, geometry, version. Written
/// beside and renamed into place. The same input gives the same bytes. Throws OutputError (a full
/// disk, say), Interrupted.
void write_form_factors(const std::filesystem::path& path, const radiosity::PatchMesh& mesh,
                        const FormFactorRows& rows, const FormFactorFileOptions& options = {});

/// The same for an operator in memory.
void write_form_factors(const std::filesystem::path& path, const radiosity::PatchMesh& mesh,
                        const radiosity::Transport& transport,
                        const FormFactorFileOptions& options = {},
                        const radiosity::Progress& progress = {});

/// The attribute `fingerprint` of a form-factor file; nothing if there is no such file.
std::optional<std::string> read_fingerprint(const std::filesystem::path& path);

}  // namespace io
