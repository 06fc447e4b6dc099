#include "radiosity/assembly/memory_sink.h"

#include "radiosity/assembly/shared_tiles.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/scene/whole_mesh.h"
#include "radiosity/visibility/visibility.h"

namespace radiosity {

Assembly assemble_exchange_areas(const PatchMesh& mesh, const WholeMesh& whole,
                                 const Visibility& visibility, const TransportOptions& options,
                                 const Coverage& coverage) {
  const Eigen::VectorXd covered = coverage.share.head(mesh.size());
  MemorySink sink(mesh.area, covered, options.ranks);
  if (options.ranks != nullptr) {
    share_tiles(whole, visibility, options, coverage, TileKeeper::by_sums, sink);
  } else {
    assemble_tiles(whole, visibility, options, coverage, sink);
  }
  return sink.finish();
}

}  // namespace radiosity
