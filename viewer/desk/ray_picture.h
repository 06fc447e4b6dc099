#pragma once

#include <memory>
#include <vector>

#include "io/picture/color_map.h"
#include "io/picture/rgb_picture.h"
#include "radiosity/base/progress.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/scene/scene.h"
#include "radiosity/visibility/visibility.h"
#include "viewer/desk/hidden_surfaces.h"
#include "viewer/desk/isolines.h"

namespace viewer {

/// Colours at the corners of patches: slot 4 i + k is corner k of patch i. One of the two is empty.
struct CornerColors {
  std::vector<io::Rgb> colors;   ///< 8-bit sRGB
  std::vector<float> positions;  ///< on the colour map, in (0, 1); negative: nothing is known
  io::ColorMap map = io::ColorMap::viridis;
  std::vector<IsoLevel> levels = {};  ///< of `positions`, that isolines are drawn of
};

struct RayPictureOptions {
  int width = 0;    ///< pixels
  int height = 0;   ///< pixels
  int samples = 1;  ///< rays in each pixel along either side
  bool hides_backs = true;
  bool has_edges = false;  ///< of patches, where these are larger than some pixels
  double line_width = 1;   ///< of edges and outlines, pixels; isolines are half as wide again
  HiddenSurfaces hidden = {};
  bool has_outlines = false;  ///< of surfaces, as `make_outlines` has them
  radiosity::Progress progress = {};
};

/// What a camera sees of many patches: the same picture that a graphics card would draw of them,
/// by rays, so that time and memory hardly grow with their number. Colours are blended within each
/// patch, about its centre, and then over a pixel's samples. Same input, same picture, at any
/// number of threads. Throws Interrupted.
io::RgbPicture ray_picture(const radiosity::PatchMesh& mesh,
                           const radiosity::Visibility& visibility, const CornerColors& corners,
                           const radiosity::Camera& camera, const RayPictureOptions& options);

/// 8-bit sRGB where nothing is, of backs and of values that are not known.
inline constexpr io::Rgb kBackgroundColor = {33, 36, 41};
inline constexpr io::Rgb kBackColor = {77, 79, 84};
inline constexpr io::Rgb kUnknownColor = {115, 115, 115};
inline constexpr io::Rgb kEdgeColor = {13, 13, 13};

}  // namespace viewer
