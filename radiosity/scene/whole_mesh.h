#pragma once

#include <optional>

#include "radiosity/scene/patch_mesh.h"

namespace radiosity {

/// All patches of a symmetric whole: those of `part`, then image after image in the order of
/// PatchMesh::images, n_parts times as many. Patch i of the part is i + g n in image g (0 is the
/// part itself). The result has no images.
PatchMesh make_whole(const PatchMesh& part);

/// The whole that a mesh is a part of: the mesh itself, without a copy, if it has no images. Refers
/// to it.
class WholeMesh {
 public:
  explicit WholeMesh(const PatchMesh& part) : part_(part) {
    if (!part.images.empty()) made_ = make_whole(part);
  }

  [[nodiscard]] const PatchMesh& mesh() const { return made_ ? *made_ : part_; }
  /// How many times the part it is, with itself.
  [[nodiscard]] Index n_parts() const { return static_cast<Index>(part_.images.size()) + 1; }

 private:
  const PatchMesh& part_;
  std::optional<PatchMesh> made_;
};

}  // namespace radiosity
