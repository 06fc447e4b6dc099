#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "radiosity/scene/patch_mesh.h"

namespace radiosity {

/// A rectangle of an atlas that shows the patches of one polygon, or of one side of it.
struct AtlasChart {
  std::vector<std::int32_t> patches;  ///< in increasing order
  Vec3 origin = Vec3::Zero();         ///< the rectangle's corner, m: the middle of its first texel
                                      ///< but for gutters
  Vec3 across = Vec3::Zero();         ///< unit; to the right in the atlas
  Vec3 down = Vec3::Zero();           ///< unit; downwards in it
  Eigen::Vector2d extent = Eigen::Vector2d::Zero();  ///< of the patches, m: across and down
  int x = 0;      ///< texels, from the left of the atlas, gutter included
  int y = 0;      ///< likewise from the top
  int width = 0;  ///< texels, gutters included
  int height = 0;
};

/// Where the points of patches are in one picture, none of them twice.
struct LightAtlas {
  int width = 0;     ///< texels
  int height = 0;    ///< likewise
  double texel = 0;  ///< side of a texel, m, everywhere
  std::vector<AtlasChart> charts;
  std::vector<std::int32_t> chart;  ///< per patch

  /// Where a point of the chart's plane lies, in texels from the left top; the middle of the first
  /// texel is (0.5, 0.5).
  [[nodiscard]] Eigen::Vector2d coordinates(const AtlasChart& of, const Vec3& point) const;
  /// The point in the middle of texel (x, y).
  [[nodiscard]] Vec3 point(const AtlasChart& of, int x, int y) const;
};

/// Lays out the patches' polygons in at most `size` x `size` texels, as large as they fit: by rows
/// of falling height, each polygon in the smallest rectangle along one of its edges, with a gutter
/// of a texel around it. What is interpolated between four texels at a point of a polygon then lies
/// in its chart. Throws MeshError if there are too many polygons.
LightAtlas make_light_atlas(const PatchMesh& mesh, int size = 1024);

}  // namespace radiosity
