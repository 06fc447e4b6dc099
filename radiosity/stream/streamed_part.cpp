#include "radiosity/stream/streamed_part.h"

#include "radiosity/assembly/exchange_assembly.h"
#include "radiosity/assembly/tile_part.h"
#include "radiosity/scene/whole_mesh.h"
#include "radiosity/visibility/coverage.h"

namespace radiosity {

void make_streamed_part(const PatchMesh& mesh, const Visibility& visibility,
                        const StreamOptions& options, WorkPart part, TileStore& store) {
  const WholeMesh whole(mesh);
  const Coverage coverage = find_coverage(whole.mesh(), plane_thickness(whole.mesh()));
  TilePartSink sink(store, part);
  assemble_tiles(whole, visibility, assembly_options(options), coverage, sink);
}

void visit_part_records(const TileStore& store, WorkPart part, const RecordVisitor& visit) {
  const Strips& strips = store.layout().strips;
  const TilePart tiles(strips, part);
  for (Index column = 0; column < strips.size(); ++column) {
    for (Index row = 0; row <= column; ++row) {
      if (tiles.owns(row, column)) visit(store.record(row, column));
    }
  }
}

}  // namespace radiosity
