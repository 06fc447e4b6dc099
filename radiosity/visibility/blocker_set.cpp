#include "radiosity/visibility/blocker_set.h"

#include <algorithm>
#include <utility>

#include "radiosity/base/median_split.h"
#include "radiosity/scene/surface_pieces.h"
#include "radiosity/visibility/body_finder.h"
#include "radiosity/visibility/occluders.h"
#include "radiosity/visibility/outer_planes.h"
#include "radiosity/visibility/polytope.h"

namespace radiosity {
namespace {

/// Pieces of so many polygons are given bodies around and within.
constexpr std::size_t kManyPolygons = 24;
/// Polygons of more sides are given simpler ones around and within.
constexpr std::size_t kManySides = 16;

Blocker polygon_blocker(const Occluder& occluder) {
  Blocker result;
  result.faces = {{occluder.normal, occluder.offset}, {-occluder.normal, -occluder.offset}};
  for (std::size_t k = 0; k < occluder.corners.size(); ++k) {
    const std::size_t next = k + 1 < occluder.corners.size() ? k + 1 : 0;
    result.edges.push_back({occluder.corners[k], occluder.corners[next], 0, 1});
  }
  result.corners = occluder.corners;
  result.box = occluder.box;
  set_sphere(result);
  if (result.corners.size() <= kManySides) return result;
  const std::optional<Blocker> outer = enclosing_polygon(result.corners, result.faces[0]);
  if (!outer) return result;
  // The least size at which all corners of the shrunk polygon are within.
  double factor = 1;
  for (const Blocker::Edge& edge : result.edges) {
    const Vec3 outwards = (edge.end - edge.start).cross(occluder.normal).normalized();
    const double reach = outwards.dot(edge.start - result.center);
    for (const Vec3& corner : outer->corners) {
      const double height = outwards.dot(corner - result.center);
      if (height > reach) factor = std::min(factor, reach / height);
    }
  }
  if (factor > 0) result.inner.push_back(shrunk(*outer, result.center, factor));
  result.outer.push_back(*outer);
  return result;
}

class BlockerSetBuilder {
 public:
  BlockerSetBuilder(const PatchMesh& mesh, double thickness) : mesh_(mesh), thickness_(thickness) {}

  BlockerSet build() {
    std::vector<std::int32_t> one_sided;
    std::vector<std::int32_t> loose;
    for (const std::int32_t i : find_blocking_patches(mesh_, thickness_)) {
      (mesh_.twin[i] < 0 ? one_sided : loose).push_back(i);
    }
    const SurfacePieces pieces = find_surface_pieces(mesh_, one_sided, thickness_);
    const VertexBlocks vertices(mesh_);
    std::vector<std::int32_t> items;
    for (const SurfacePiece& piece : pieces.pieces) {
      if (const auto body = find_body(pieces, piece, vertices, thickness_)) {
        items.push_back(add_leaf(body->blocker));
        continue;
      }
      std::vector<std::int32_t> patches;
      for (const std::int32_t f : piece.facets) patches.push_back(one_sided[f]);
      if (piece.facets.size() < kManyPolygons) {
        loose.insert(loose.end(), patches.begin(), patches.end());
        continue;
      }
      add_piece(pieces, piece, make_occluders(mesh_, patches, thickness_), loose, patches, items);
    }
    std::sort(loose.begin(), loose.end());
    std::vector<Occluder> occluders = make_occluders(mesh_, loose, thickness_);
    drop_covered_occluders(occluders, thickness_);
    for (const Occluder& occluder : occluders) items.push_back(add_leaf(polygon_blocker(occluder)));
    if (!items.empty()) result_.root = join({items.data(), items.size()});
    return std::move(result_);
  }

 private:
  std::int32_t add_leaf(Blocker blocker) {
    result_.nodes.push_back({blocker.box, static_cast<std::int32_t>(result_.blockers.size())});
    result_.blockers.push_back(std::move(blocker));
    return static_cast<std::int32_t>(result_.nodes.size()) - 1;
  }

  /// A piece of many polygons gets a node of its own; others become loose.
  void add_piece(const SurfacePieces& pieces, const SurfacePiece& piece,
                 const std::vector<Occluder>& occluders, std::vector<std::int32_t>& loose,
                 const std::vector<std::int32_t>& patches, std::vector<std::int32_t>& items) {
    // A hollow has everything inside.
    if (occluders.size() < kManyPolygons || piece.is_hollow()) {
      loose.insert(loose.end(), patches.begin(), patches.end());
      return;
    }
    std::vector<std::int32_t> leaves;
    std::vector<Vec3> corners;
    for (const Occluder& occluder : occluders) {
      leaves.push_back(add_leaf(polygon_blocker(occluder)));
      corners.insert(corners.end(), occluder.corners.begin(), occluder.corners.end());
    }
    const std::int32_t node = join({leaves.data(), leaves.size()});
    if (std::optional<Blocker> outer = enclosing_polytope(corners)) {
      if (piece.is_solid()) {
        if (auto inner = find_inner_body(pieces, piece, *outer)) {
          result_.nodes[node].inner.push_back(std::move(*inner));
        }
      }
      result_.nodes[node].outer.push_back(std::move(*outer));
    }
    items.push_back(node);
  }

  /// A binary tree over nodes, halved along the longest side of the box of their centres.
  std::int32_t join(std::span<std::int32_t> nodes) {
    if (nodes.size() == 1) return nodes[0];
    Box3 box;
    Box3 centers;
    for (const std::int32_t k : nodes) {
      box.extend(result_.nodes[k].box);
      centers.extend(result_.nodes[k].box.center());
    }
    int axis = 0;
    centers.sizes().maxCoeff(&axis);
    const auto halves = split_at_median(
        nodes, [&](std::int32_t k) { return std::pair(result_.nodes[k].box.center()[axis], k); });
    const std::int32_t left = join(halves[0]);
    const std::int32_t right = join(halves[1]);
    result_.nodes.push_back({box, -1, left, right});
    return static_cast<std::int32_t>(result_.nodes.size()) - 1;
  }

  const PatchMesh& mesh_;
  double thickness_;
  BlockerSet result_;
};

}  // namespace

BlockerSet make_blockers(const PatchMesh& mesh, double thickness) {
  return BlockerSetBuilder(mesh, thickness).build();
}

}  // namespace radiosity
