#pragma once

#include <memory>
#include <optional>
#include <string>

#include "radiosity/base/geometry.h"
#include "radiosity/scene/patch_mesh.h"
#include "viewer/desk/look.h"
#include "viewer/work/known.h"

namespace viewer {

/// Light that was pinned, to compare later light with.
struct Pinned {
  Known known;           ///< light and its patches, without form factors, which take the memory
  std::string standing;  ///< how far it could be trusted
};

/// What is pinned, and how that goes with what is open.
struct Pinning {
  std::shared_ptr<const Pinned> light;  ///< null if none is
  bool has_same_patches = false;        ///< it is of the patches that are open
  int model = 0;                        ///< Session::Versions::model at which that was seen
  double split = 0.5;                   ///< where it ends side by side, of the picture's width
};

/// Beyond so many patches, pinned light cannot be drawn beside that of now in each frame.
inline constexpr radiosity::Index kMostBeside = 30'000;

/// "none", "wipe", "difference".
std::string comparison_name(Comparison comparison);
/// Empty if it is none of them.
std::optional<Comparison> comparison_named(const std::string& name);

/// Whether both are the same patches in the same order.
bool has_same_patches(const radiosity::PatchMesh& a, const radiosity::PatchMesh& b);

/// Why light of a model cannot be compared so with what is pinned; "" if it can.
std::string comparison_refusal(const Pinning& pinning, const Model& now, Comparison comparison);

/// Sees whether the pinned light is of the patches that are open now, and gives up what is of
/// another scene and what cannot be compared any more. Returns what there is to say, or "".
std::string follow_model(Pinning& pinning, Look& look, const Model& now, int version);

/// Pinned light as if it were that of a model of the same patches: with its form factors.
Known with_form_factors_of(const Model& now, Known before);

/// Whether what is shown can be had of pinned light: not what is about one patch or an iteration.
bool is_comparable(const Look& look);

/// What is shown, now minus before, of the same patches and bands; of true colour the luminance.
/// Empty if that is not known of both.
std::optional<ShownField> shown_difference(const Known& now, const Known& before, const Look& look);

/// A linear scale about 0 of differences: as wide as `look` asks or fits 98 % of them, so that what
/// has not changed looks so.
io::ColorScale difference_scale(const Look& look, const ShownField& differences);

}  // namespace viewer
