#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <span>

#include "radiosity/picture/primary_rays.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/visibility/incident_light.h"

namespace radiosity {

/// Gathers light at points: the irradiance H(x) = Σ_j B_j F(x → visible part of patch j) + E(x)
/// from patches of constant radiosity B_j, without sampling: what hides a patch is cut out of it
/// exactly as seen from x, and the rest has Lambert's closed form. E(x) is the light that comes
/// from no patch, with sharp shadows. Immutable; may be used by many threads.
class FinalGather {
 public:
  /// `radiosity` is n_patches x n_bands, W/m². The mesh must outlive this.
  FinalGather(const PatchMesh& mesh, const Eigen::MatrixXd& radiosity,
              const IncidentLight& incident = {});
  ~FinalGather();
  FinalGather(const FinalGather&) = delete;
  FinalGather& operator=(const FinalGather&) = delete;

  /// Irradiance at points on patches, W/m², n_points x n_bands. Points that lie close together in
  /// one plane share most of the work, and form factors to distant patches are interpolated among
  /// many of them; a point by itself gets the exact sum. A point in the plane of a patch gets
  /// nothing from it, one inside a closed body nothing from without.
  [[nodiscard]] Eigen::MatrixXd irradiance(std::span<const SurfacePoint> points) const;
  /// The same of points anywhere that lie in one plane, to the side that its normal of unit length
  /// tells.
  [[nodiscard]] Eigen::MatrixXd irradiance(std::span<const Vec3> points, const Vec3& normal) const;
  [[nodiscard]] Index n_bands() const;

  /// Takes the number of a patch, of image g of a symmetric part of n patches i + g n, and a convex
  /// part of it with its corners relative to the point, counter-clockwise as seen from there.
  using Sight = std::function<void(std::int32_t patch, std::span<const Vec3> piece)>;
  /// Shows all parts of patches with radiosity that a point sees on the side of `normal` of the
  /// plane through it, exactly as `irradiance` has them.
  void look(const Vec3& point, const Vec3& normal, const Sight& sight) const;

  /// Whether two patches lie in one plane and face the same way.
  [[nodiscard]] bool are_coplanar(std::int32_t i, std::int32_t j) const;

  /// A point that rays have found, moved to where it belongs by a millionth of the scene's size: on
  /// the patch's plane, inside rather than outside its border, and not inside a body that stands on
  /// it. Points well outside the border are taken to be on a neighbour in the same plane.
  [[nodiscard]] SurfacePoint settled(const SurfacePoint& point) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace radiosity
