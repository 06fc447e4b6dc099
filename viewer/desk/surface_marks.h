#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "radiosity/scene/patch_mesh.h"
#include "viewer/desk/surface_line.h"
#include "viewer/work/worker.h"

namespace viewer {

/// Surfaces that stand out in the list and, if they are outlined, in the picture. Of very many
/// patches the lines come in the background.
class SurfaceMarks {
 public:
  using Mesh = std::shared_ptr<const radiosity::PatchMesh>;

  /// Marks these alone.
  void mark(std::vector<std::int32_t> surfaces);
  /// The same with outlines; `surfaces` are some of the mesh.
  void outline(Mesh mesh, std::vector<std::int32_t> surfaces);
  /// Finds the outlines anew if the patches are others.
  void follow(const Mesh& mesh);
  /// Takes in lines that were found. Whether there were some.
  bool update() { return finding_.deliver(); }

  /// Rising.
  [[nodiscard]] const std::vector<std::int32_t>& surfaces() const { return surfaces_; }
  [[nodiscard]] bool contains(std::int32_t surface) const;
  [[nodiscard]] const std::vector<SurfaceLine>& lines() const { return lines_; }

 private:
  std::vector<std::int32_t> surfaces_;
  std::vector<SurfaceLine> lines_;
  Mesh mesh_;  // of which these are; null without outlines
  Worker finding_;
};

}  // namespace viewer
