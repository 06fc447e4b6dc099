#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "radiosity/base/geometry.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/visibility/visibility.h"

namespace viewer {

/// A piece of a line, m.
struct OutlinePiece {
  radiosity::Vec3 from;
  radiosity::Vec3 to;
};

/// The edges of a mesh's faces: of the polygons that it was made of or, if it does not know them,
/// of its patches. Where two faces go on smoothly there is none; of very many faces there are none
/// at all, and of many edges the longest.
class BackOutlines {
 public:
  explicit BackOutlines(const radiosity::PatchMesh& mesh);

  /// What shows where faces are that `eye` (m) sees from the back, which are not drawn then: edges
  /// that belong to such faces alone, as far as no front hides them.
  [[nodiscard]] std::vector<OutlinePiece> of_hidden_backs(
      const radiosity::Vec3& eye, const radiosity::Visibility& visibility) const;

 private:
  struct Face {
    radiosity::Vec3 point;
    radiosity::Vec3 normal;
    bool is_two_sided = false;
  };
  struct Edge {
    radiosity::Vec3 from;
    radiosity::Vec3 to;
    std::vector<std::size_t> faces;
  };
  void add_face(std::span<const radiosity::Vec3> corners, bool is_two_sided);
  void join_edges();

  std::vector<Face> faces_;
  std::vector<Edge> edges_;
};

}  // namespace viewer
