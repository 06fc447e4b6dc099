#pragma once

#include <Eigen/Core>
#include <functional>
#include <span>
#include <vector>

#include "radiosity/scene/glazing.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/scene/scene.h"
#include "radiosity/visibility/visible_sky.h"

namespace radiosity {

/// What points see of each part of the sky, with all that panes on the way let through, of one
/// band: the sides of daylight coefficients that do not depend on any sky. Immutable; may be used
/// by many threads.
class PartialSky {
 public:
  /// The parts lie above the horizon of the scene's sky; corners as VisibleSky has them. `weights`
  /// make one value of what panes let through of the bands. The mesh must outlive this.
  PartialSky(const Scene& scene, const PatchMesh& mesh, std::vector<ConvexPolygon> parts,
             const Eigen::VectorXd& weights);

  /// Adds `factor` times ∫ τ cosθ dω over what an element sees of each part, and in the last entry
  /// over what it sees below the horizon, sr; n_parts + 1.
  void add(const Vec3& point, const Vec3& normal, double factor,
           Eigen::Ref<Eigen::VectorXd> sums) const;

  /// Visits the directions, of unit length, in which an element sees the sky, with τ cosθ.
  void visit_beams(const Vec3& point, const Vec3& normal, std::span<const Vec3> directions,
                   const std::function<void(std::size_t, double)>& visit) const;

 private:
  [[nodiscard]] double through(std::span<const VisibleSky::Pane> panes,
                               const Vec3& direction) const;
  [[nodiscard]] double section(const ConvexPolygon& part, std::span<const VisibleSky::Pane> panes,
                               const Vec3& normal) const;

  /// A cap about a part that holds it.
  struct Cap {
    Vec3 middle;
    double radius;  // rad
  };
  static Cap cap_about(const ConvexPolygon& part);

  Vec3 up_;
  std::vector<ConvexPolygon> parts_;
  std::vector<Cap> caps_;
  std::vector<Glazing> glazings_;  // of one band
  std::vector<ConvexPolygon> cells_;
  VisibleSky visible_;
};

}  // namespace radiosity
