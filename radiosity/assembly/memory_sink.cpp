#include "radiosity/assembly/memory_sink.h"

#include "radiosity/scene/patch_mesh.h"
#include "radiosity/visibility/visibility.h"

namespace radiosity {

Assembly assemble_exchange_areas(const PatchMesh& mesh, const Visibility& visibility,
                                 const TransportOptions& options, const Coverage& coverage) {
  MemorySink sink(mesh.area, coverage.share);
  assemble_tiles(mesh, visibility, options, coverage, sink);
  return sink.finish();
}

}  // namespace radiosity
