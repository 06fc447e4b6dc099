#pragma once

#include <Eigen/Core>
#include <functional>
#include <span>
#include <vector>

#include "radiosity/base/box_tree.h"
#include "radiosity/base/geometry.h"
#include "radiosity/base/progress.h"
#include "radiosity/polygon/flat_difference.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/visibility/occluders.h"

namespace radiosity {

/// What parallel light reaches of a mesh. All patches block it, whichever side they turn to it, but
/// for those in the plane of what is lit. Shadows are exact up to rounding: whatever is in the way
/// is cut out of a patch as a polygon in the plane normal to the beam, which is visibility from a
/// point at infinity (Weiler & Atherton 1977). Immutable; may be used by many threads.
class SunShadows {
 public:
  /// `direction` is the one in which light travels, of unit length. The mesh must outlive this.
  /// `pane` tells of each patch which kind of pane it is, -1 = none; empty: none is. Panes do not
  /// block.
  SunShadows(const PatchMesh& mesh, const Vec3& direction, std::span<const int> pane = {});

  /// What a kind of pane lets through at a cosine from its normal, one value per band.
  using PaneFactor = std::function<Eigen::VectorXd(int kind, double cosine)>;
  /// The day-lit share of each patch's area times what panes on the way let through, n_patches x
  /// n_bands.
  [[nodiscard]] Eigen::MatrixXd shares_through_panes(Index n_bands, const PaneFactor& factor,
                                                     const Progress& progress = {}) const;
  /// What panes let through of the beam that a point on a surface with that normal gets if it is
  /// lit, n_bands.
  [[nodiscard]] Eigen::VectorXd factor_at(const Vec3& point, const Vec3& normal, Index n_bands,
                                          const PaneFactor& factor) const;

  /// The day-lit share of each patch's area, n_patches, in [0, 1]; 0 where the emitting side is
  /// turned away or along the beam. Same input, same bits, at any number of threads. Throws
  /// Interrupted.
  [[nodiscard]] Eigen::VectorXd lit_shares(const Progress& progress = {}) const;

  /// Whether light reaches a point (m) on a surface with that unit normal. What is less far in
  /// front of the surface than points may be off a plane does not block it; on the border of a
  /// shadow it is dark.
  [[nodiscard]] bool is_lit(const Vec3& point, const Vec3& normal) const;

  /// Cosine of the angle between a unit normal and the way to the sun; 0 where that is below the
  /// surface or along it.
  [[nodiscard]] double cosine(const Vec3& normal) const;

 private:
  /// Coordinates across the beam, and up along it.
  [[nodiscard]] Point2 across(const Vec3& x) const { return {u_.dot(x), v_.dot(x)}; }
  [[nodiscard]] Vec3 in_frame(const Vec3& x) const { return {u_.dot(x), v_.dot(x), up_.dot(x)}; }
  /// What an occluder hides of what lies in a plane, across the beam; empty if nothing.
  [[nodiscard]] FlatPolygon shadow_on(const Occluder& occluder, const Vec3& on_plane,
                                      const Vec3& normal) const;
  /// The lit parts of a patch, across the beam, and the area of all of it.
  struct Lit {
    std::vector<FlatPolygon> parts;
    double area = 0;
    bool is_cut = false;
  };
  [[nodiscard]] Lit lit_parts(Index patch) const;
  [[nodiscard]] double lit_share(Index patch) const;
  [[nodiscard]] bool is_in_plane(const Occluder& occluder, Index patch) const;
  /// Whether a point meets the occluder on its way to the sun.
  [[nodiscard]] bool meets(const Occluder& occluder, const Vec3& x, double cosine_there) const;
  /// Adds the areas of parts times the factors of the panes from the first on.
  void add_through(Index patch, std::vector<FlatPolygon> parts, std::size_t first,
                   const Eigen::VectorXd& so_far, const PaneFactor& factor,
                   Eigen::VectorXd& sum) const;

  const PatchMesh& mesh_;
  Vec3 center_;
  Vec3 up_;  // towards the sun
  Vec3 u_, v_;
  double thickness_;                 // how far off a plane points may be, m
  double rounding_;                  // how far apart equal points may be across the beam, m
  double top_ = 0;                   // along the beam, of all that blocks
  std::vector<Occluder> occluders_;  // relative to the centre
  BoxTree tree_;                     // of them, in the beam's frame
  struct Pane {
    Occluder occluder;
    int kind;
  };
  std::vector<Pane> panes_;
};

}  // namespace radiosity
