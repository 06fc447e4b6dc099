#pragma once

#include <optional>
#include <string>

#include "radiosity/base/geometry.h"
#include "radiosity/base/progress.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/scene/scene.h"

namespace meshing {

/// How fine the patches are. Set at most one of max_edge and n_patches; with neither, each input
/// polygon is one patch where it can be (--as-is): triangles and planar convex quads stay as they
/// are, in file order, other polygons are triangulated. With one of them patches end where other
/// surfaces stand on them or pass through them (`polygon_contact_lines`).
struct PatchOptions {
  /// No patch edge is longer, m, but for those that begin at a cut along a contact line: √2 times.
  std::optional<double> max_edge = {};
  std::optional<long> n_patches = {};  ///< about so many patches, of about equal size
  /// With n_patches: edges up to this length stay whole, m, even if that leaves fewer patches.
  std::optional<double> least_edge = {};
  /// Of many patches it tells how far they are made: "dividing".
  radiosity::Progress progress = {};
};

/// Number of patches where nobody says how fine they shall be, ...
inline constexpr long kDefaultPatches = 2000;
/// ... unless that many more than polygons are more.
inline constexpr long kDefaultBeyondPolygons = 1000;

/// How fine patches shall be, as people say it: at most one of the first three.
struct PatchChoice {
  std::optional<double> max_edge = {};  ///< m
  std::optional<long> n_patches = {};   ///< about so many
  bool as_is = false;                   ///< each input polygon is one patch
  bool adaptive = false;                ///< refined where the light varies, later
};

/// The options for what was chosen. Without a choice there are kDefaultPatches, or
/// kDefaultBeyondPolygons more than there are polygons: where these are many, the large ones shall
/// show the shadows of the small ones, but from kDefaultPatches polygons on no edge below twice the
/// usual length (the median of the polygons' longest edges) is divided. With `adaptive` there are
/// no more than kDefaultPatches, since refinement makes its own.
PatchOptions make_patch_options(const PatchChoice& choice, const radiosity::Scene& scene,
                                const radiosity::Progress& progress = {});

/// A number of patches that make_patches will reach, known without making any.
radiosity::Index least_patches(const radiosity::Scene& scene, const PatchOptions& options);

/// Subdivides the scene's polygons into well-shaped patches: quads stay quads, triangles are split
/// without slivers, an edge shared by two polygons (same vertex positions) is divided alike on both
/// sides. What `crossed_patches` finds in the result could not be cut. Deterministic. Patches come
/// in the order of their polygons. Throws MeshError naming surface and polygon for zero-area
/// polygons and polygons that cross themselves (leave_out_bad_polygons() makes scenes without
/// them), and as refuse_overlapping_images() does. Of a part of a symmetric whole it has the part's
/// patches only, and what moves them to their images.
radiosity::PatchMesh make_patches(const radiosity::Scene& scene, const PatchOptions& options = {});

/// One line on the patches that reach to both sides of what stands on them (`crossed_patches`), if
/// there are any.
std::optional<std::string> uncut_warning(const radiosity::PatchMesh& mesh);

}  // namespace meshing
