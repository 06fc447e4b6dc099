#pragma once

#include <Eigen/Core>
#include <vector>

#include "radiosity/base/progress.h"
#include "radiosity/picture/shooting_sources.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/visibility/visibility.h"

namespace radiosity {

/// A first picture while the form factors are still being computed: progressive refinement (Cohen,
/// Chen, Wallace & Greenberg 1988) with rows of F made up as they are needed, and forgotten.
///
/// Approximations. Patches in one plane shoot together, some hundreds of groups in all; receivers
/// closer than four radii tell their parts apart, down to the patch. A part further away is a point
/// source at its centre (up to 4 % too bright face to face), a patch nearby Lambert's closed form
/// at the centroid of the receiver. Of a group's light arrives the share of four segments between
/// fixed points that nothing blocks: its shadows have five shades. A shot that would arrive as more
/// than was sent is scaled down, so that light never grows.
///
/// The same bits after the same number of shots, at any number of threads.
class ShootingPreview {
 public:
  /// `exitance` is n x k, W/m²; `reflectance` n x k, in [0, 1]. Mesh and visibility must outlive
  /// this.
  ShootingPreview(const PatchMesh& mesh, const Visibility& visibility,
                  const Eigen::MatrixXd& exitance, const Eigen::MatrixXd& reflectance);

  /// Shoots from the group of patches with the most unshot power over all columns, if there is any.
  void shoot();
  /// Shoots as often as fits into the time, s, and at least once. Reports "preview"; throws
  /// Interrupted.
  void shoot(double seconds, const Progress& progress = {});

  [[nodiscard]] int n_shots() const { return n_shots_; }
  /// B, shot and unshot light together, W/m², n x k.
  [[nodiscard]] Eigen::MatrixXd radiosity() const;
  /// B with a guess at what the unshot light will add (Cohen et al. 1988): ρ_i R ΣAU / ΣA, the
  /// unshot radiosity U spread evenly, with all its reflections R = 1 / (1 - ρ), ρ the mean.
  /// Without the guess in columns of mean reflectance 1. W/m², n x k.
  [[nodiscard]] Eigen::MatrixXd with_ambient() const;
  /// The part of B that no patch has shot, W/m², n x k.
  [[nodiscard]] Eigen::MatrixXd unshot() const { return unshot_; }
  /// Unshot power as a share of what is emitted; 0 if nothing is.
  [[nodiscard]] double unshot_share() const;

 private:
  using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  [[nodiscard]] std::size_t brightest_group() const;
  /// Averages the unshot radiosity over each part of the group.
  void prepare_parts(const ShootingSources::Group& group);
  [[nodiscard]] double visible_share(const ShootingSources::Group& group,
                                     std::int32_t receiver) const;
  /// Irradiance of a receiver from the group, but for what blocks it, is added to `irradiance`.
  void gather(const ShootingSources::Group& group, std::int32_t receiver,
              Eigen::Ref<Eigen::RowVectorXd> irradiance) const;

  const PatchMesh& mesh_;
  const Visibility& visibility_;
  ShootingSources sources_;
  Eigen::VectorXd area_;
  RowMatrix exitance_;
  RowMatrix reflectance_;
  RowMatrix irradiance_;
  RowMatrix unshot_;
  RowMatrix arrived_;     // of the shot under way
  RowMatrix part_light_;  // unshot radiosity of each node, of the group under way
  double thickness_ = 0;
  int n_shots_ = 0;
};

}  // namespace radiosity
