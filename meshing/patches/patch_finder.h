#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "meshing/patches/contact_lines.h"
#include "radiosity/base/box_tree.h"
#include "radiosity/base/geometry.h"
#include "radiosity/scene/patch_mesh.h"

namespace meshing {

/// The box around a segment, a margin larger on each side, m.
radiosity::Box3 box_of(const Segment& segment, double margin);

/// Finds the patches of polygons with lines, which are to be cut along these.
class PatchFinder {
 public:
  /// A corner is moved by no more than this share of the shortest edge that it has there.
  static constexpr double kLongestMove = 0.3;

  /// `lines` of each polygon; `tolerance` of what touches, m. The mesh must outlive this.
  PatchFinder(const radiosity::PatchMesh& mesh, std::span<const std::vector<Segment>> lines,
              double tolerance);

  /// Patches of a polygon that have a point or may once their corners have moved, in increasing
  /// order; of two back to back the front.
  [[nodiscard]] std::vector<std::int32_t> near(const radiosity::Vec3& point,
                                               std::int32_t polygon) const;
  /// The same of those within twice the tolerance of a segment.
  [[nodiscard]] std::vector<std::int32_t> near(const Segment& segment, std::int32_t polygon) const;

 private:
  std::vector<radiosity::Box3> find_boxes(std::span<const std::vector<Segment>> lines);

  const radiosity::PatchMesh& mesh_;
  double tolerance_;
  std::vector<std::int32_t> patch_;  // what the boxes belong to
  std::vector<radiosity::Box3> boxes_;
  radiosity::BoxTree tree_;
};

}  // namespace meshing
