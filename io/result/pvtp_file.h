#pragma once

#include <filesystem>

#include "io/result/result_file.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/solve/solution.h"

namespace io {

/// One of the pieces that a result is written in: patches n part / n_parts to before
/// n (part + 1) / n_parts.
struct PiecePart {
  int part = 0;  ///< 0 <= part < n_parts
  int n_parts = 1;
};

/// The file of a piece, beside the .pvtp: F.pvtp has F_0.vtp, F_1.vtp, ...
std::filesystem::path piece_path(const std::filesystem::path& pvtp, int part);

/// Writes a piece of what `io::write` puts into a .vtp: its patches in their order with their
/// arrays, its own points, and all field data; twins and families by their numbers in the whole.
/// All together are those of the one file, whoever writes which. Throws OutputError naming the
/// piece's file.
void write_piece(const std::filesystem::path& pvtp, PiecePart part,
                 const radiosity::PatchMesh& mesh, const radiosity::Solution& solution,
                 const ResultOptions& options = {});

/// Writes the .pvtp (VTK XML, parallel), which names the pieces and their arrays; the last of all,
/// so that what it names is there. Throws OutputError.
void write_piece_index(const std::filesystem::path& pvtp, int n_parts,
                       const radiosity::PatchMesh& mesh, const radiosity::Solution& solution,
                       const ResultOptions& options = {});

}  // namespace io
