#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "radiosity/base/progress.h"
#include "radiosity/operator/transport.h"
#include "radiosity/scene/patch_mesh.h"

namespace io {

/// Version of the layout of compressed operators, to be raised when an older reader would misread
/// it. Dense ones are form-factor files.
inline constexpr std::int64_t kOperatorVersion = 1;

/// What an operator file holds beside its operator.
struct OperatorFileOptions {
  double tolerance = 1e-2;  ///< the relative error that was asked of the form factors
  std::string geometry{};   ///< of the scene's surfaces, so that it is not used for others
  /// Of the computation, which read_fingerprint() tells; or nothing.
  std::string fingerprint{};
};

/// An operator that was read, and what it belongs to.
struct StoredOperator {
  radiosity::PatchMesh mesh;
  std::unique_ptr<radiosity::Transport> transport;
  double tolerance = 0;  ///< the relative error that was asked of the form factors
  std::string geometry;  ///< of the scene's surfaces; empty if the file does not tell
};

/// Writes an operator so that `read_operator` has it again: a compressed one
/// (radiosity::CompressedTransport) as the arrays of its blocks, to the last bit; any other by
/// rows, as write_form_factors does. Beside and renamed into place; the same input gives the same
/// bytes. Throws OutputError (a full disk, say); SolveError if it has no rows; Interrupted.
void write_operator(const std::filesystem::path& path, const radiosity::PatchMesh& mesh,
                    const radiosity::Transport& transport, const OperatorFileOptions& options = {},
                    const radiosity::Progress& progress = {});

/// Whether the file holds a compressed operator. Throws SceneError if it is no HDF5 file.
bool is_compressed_operator(const std::filesystem::path& path);

/// Reads an operator, or the form factors of `radiosity form-factors`, which become a dense one.
/// All sizes and indices are checked, so that whatever the file holds, the operator can be used.
/// Throws SceneError naming the file if it is no such file, of a newer version, cut off or damaged;
/// MemoryShortage if it does not fit into `memory` bytes (0 = what the machine has); Interrupted.
StoredOperator read_operator(const std::filesystem::path& path,
                             const radiosity::Progress& progress = {}, std::size_t memory = 0);

}  // namespace io
