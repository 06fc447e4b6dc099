#pragma once

#include <Eigen/Core>
#include <memory>

#include "radiosity/assembly/transport_options.h"
#include "radiosity/base/fingerprint.h"
#include "radiosity/base/work_part.h"
#include "radiosity/compressed/compressed_transport.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/visibility/visibility.h"

namespace radiosity {

/// The light that an operator is made for, besides B = 1 and others: what F B is off by is verified
/// for it, too. All n x k as solve() takes them, or empty.
struct ExpectedLight {
  Eigen::MatrixXd exitance = {};     ///< W/m²
  Eigen::MatrixXd reflectance = {};  ///< in [0, 1]
  /// What of it patches emit by themselves, if it is not all: light from these polygons is exact.
  Eigen::MatrixXd emitted = {};
};

/// Throws SolveError: a part of a symmetric whole (PatchMesh::images) has no compressed operator.
[[noreturn]] void refuse_compressed_part();

/// Makes a compressed operator in rounds, until its verified error is no more than
/// TransportOptions::tolerance or rounds no longer help (CompressionReport tells). Same input, same
/// bits, at any number of threads. KnownPairs are not used. Throws SolveError as
/// refuse_compressed_part() does of a part; MemoryShortage if it will not fit into memory;
/// OutputError if the work file can't be written, or is to be gone on with and belongs to another
/// computation; Interrupted if asked to stop.
std::unique_ptr<CompressedTransport> make_compressed_transport(const PatchMesh& mesh,
                                                               const Visibility& visibility,
                                                               const TransportOptions& options = {},
                                                               const ExpectedLight& light = {});

/// Makes, in TransportOptions::work_file, which must be named, what one part of the work has of the
/// first round, and visits its records, in fixed order. With the records of all parts in one work
/// file, make_compressed_transport() goes on from there, to the same bits: with the verification
/// and any further rounds, which need the whole. Throws as that does.
void make_compressed_part(const PatchMesh& mesh, const Visibility& visibility,
                          const TransportOptions& options, const ExpectedLight& light,
                          WorkPart part, const RecordVisitor& visit);

/// Of all that decides about the numbers, as a work file has it.
Fingerprint compressed_fingerprint(const PatchMesh& mesh, const TransportOptions& options,
                                   const ExpectedLight& light);

/// Memory that the assembly for n patches takes, about, bytes.
std::size_t compressed_transport_bytes(Index n_patches);

/// Throws MemoryShortage, with the figures and the way out, if so many patches will not fit into
/// `memory` bytes (0 = what the machine has).
void check_compressed_memory(Index n_patches, std::size_t memory = 0);

}  // namespace radiosity
