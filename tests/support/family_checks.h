#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tests/support/scene_families.h"

namespace radiosity::test {

/// How a scene is divided and how closely it is looked at.
struct CheckOptions {
  std::optional<long> n_patches = {};  ///< about so many; none = polygons as they are
  double tolerance = 1e-2;             ///< asked of the form factors
  long n_pairs = 2000;                 ///< certified pairs to be checked, at most
  int n_segments = 2;                  ///< per pair
  long n_cluster_pairs = 200;
  long n_rays = 3000;     ///< per surface
  int n_surfaces = 1000;  ///< whose rays are shot, at most
  std::uint64_t seed = 1;
};

/// What checks found.
struct Findings {
  long n_scenes = 0;
  long n_refused = 0;  ///< scenes that meshing named as bad
  long n_patches = 0;
  long n_visible = 0;        ///< certified pairs that were checked
  long n_hidden = 0;         ///< the same
  long n_wrong_visible = 0;  ///< of these: a segment is blocked, or an end of it covered
  long n_wrong_hidden = 0;   ///< of these: a segment is free
  long n_wrong_values = 0;   ///< certain values above the unobstructed one
  long n_cluster_verdicts = 0;
  long n_wrong_clusters = 0;
  long n_factors = 0;        ///< between surfaces
  long n_wrong_factors = 0;  ///< beyond 5 standard errors of the rays, twice
  long n_closed = 0;         ///< scenes that are closed
  long n_not_closed = 0;     ///< of these: not found to be
  long n_open_rows = 0;      ///< in these
  long n_wrong_row_sums = 0;
  double worst_row_sum = 0;  ///< largest |row sum - (1 - covered share)| in closed scenes, raw
  double escaped = 0;        ///< largest share of all power that leaves a closed scene
  std::vector<std::string> failures;  ///< the first of each kind and scene, in words

  Findings& operator+=(const Findings& other);
};

/// Checks the proofs, the factors between surfaces and, in a closed scene, the row sums of one
/// scene against the oracle.
Findings check_scene(const FamilyScene& family_scene, const CheckOptions& options);

/// Factors between surfaces and one standard error of each. Empty if meshing refuses the scene.
struct SurfaceFactors {
  Eigen::MatrixXd factors;
  Eigen::MatrixXd errors;
};
std::optional<SurfaceFactors> surface_factors_of(const FamilyScene& family_scene,
                                                 std::optional<long> n_patches, double tolerance);

/// The largest difference between two results that their errors, five of each, do not explain;
/// `where` says where, in words.
double unexplained_difference(const SurfaceFactors& a, const SurfaceFactors& b, std::string& where);

}  // namespace radiosity::test
