#pragma once

#include "radiosity/base/work_part.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/stream/streamed_factors.h"
#include "radiosity/stream/tile_store.h"
#include "radiosity/visibility/visibility.h"

namespace radiosity {

/// Computes the tiles of one part of StreamedFactors (TilePart) that the store has not. What all
/// parts have made, in one store and in any order, is what StreamedFactors goes on with, to the
/// same bits. Throws as that does.
void make_streamed_part(const PatchMesh& mesh, const Visibility& visibility,
                        const StreamOptions& options, WorkPart part, TileStore& store);

/// Visits the records of a part that was made, in the order of the tiles: the same part has the
/// same bytes. Throws OutputError.
void visit_part_records(const TileStore& store, WorkPart part, const RecordVisitor& visit);

}  // namespace radiosity
