#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "radiosity/base/geometry.h"
#include "radiosity/polygon/convex_polygon.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/scene/scene.h"
#include "radiosity/visibility/occluders.h"

namespace radiosity {

/// The directions in which a point sees no surface. All patches block, from both sides, but for
/// those in the point's own plane and for panes, through which it sees. Whatever is in the way is
/// cut out exactly, on the sphere of directions: what is behind everything needs no distances.
/// Immutable; may be used by many threads.
class VisibleSky {
 public:
  /// `pane` tells of each patch which kind of pane it is, -1 = none; empty: none is.
  explicit VisibleSky(const PatchMesh& mesh, std::span<const int> pane = {});

  /// A pane that directions pass.
  struct Pane {
    int kind = 0;
    Vec3 normal;  ///< unit
  };
  /// A convex part of the directions, counter-clockwise as seen from outside the sphere; corners
  /// are relative to the point. The panes are those that all of it passes.
  using Visit = std::function<void(const ConvexPolygon& part, std::span<const Pane> panes)>;

  /// Visits what a surface element at `point` (m) with unit `normal` sees between the planes of a
  /// cell, in parts that do not overlap. A cell has corners as `Visit` has them, within a half
  /// sphere.
  void visit(const Vec3& point, const Vec3& normal, std::span<const ConvexPolygon> cells,
             const Visit& visit) const;

  /// Visits those of the directions, of unit length, in which the element sees no surface, by their
  /// number and with the panes that they pass.
  void visit_directions(const Vec3& point, const Vec3& normal, std::span<const Vec3> directions,
                        const std::function<void(std::size_t, std::span<const Pane>)>& visit) const;

 private:
  struct Glass {
    Occluder occluder;
    int kind;
  };
  Vec3 center_;
  double thickness_;                 // how far off a plane points may be, m
  std::vector<Occluder> occluders_;  // relative to the centre
  std::vector<Glass> panes_;
};

/// The eight octants about `up`, four above the horizon and then four below.
std::vector<ConvexPolygon> octants(const Vec3& up);

/// ∫ cosθ dω over directions that an element of that normal has above its horizon, sr.
double projected_solid_angle(const ConvexPolygon& directions, const Vec3& normal);

/// Which kind of pane each patch is, -1 = none, by its material's number; empty if none is.
std::vector<int> panes_of(const Scene& scene, const PatchMesh& mesh);

}  // namespace radiosity
