#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "io/picture/rgb_picture.h"
#include "viewer/desk/comparison.h"
#include "viewer/desk/isolines.h"
#include "viewer/desk/legend.h"
#include "viewer/desk/look.h"
#include "viewer/desk/orientation.h"
#include "viewer/work/known.h"

namespace viewer {

/// What is to be painted: all that it takes, so that any thread can.
struct PaintingTask {
  Known known;  ///< with a mesh
  Look look;
  UpAxis up = UpAxis::y;
  std::optional<double> exposure = {};  ///< automatic part; absent: it shall be found
  /// Light whose difference from what is known is to be shown, of the same patches; or null.
  std::shared_ptr<const Pinned> subtracted = {};
};

/// What the patches look like.
struct Painting {
  Eigen::MatrixXd values;     ///< n x 3 linear sRGB or, with a legend, n x 1 of its quantity
  bool is_smooth = false;     ///< values may be blended from patch to patch
  double exposure = 1;        ///< the automatic part
  double factor = 1;          ///< from linear sRGB to display value
  bool is_spreading = false;  ///< true colour of what gets brighter: a preview, or darkness
  bool is_light = false;      ///< true colour: `exposure` is of it
  std::optional<Legend> legend = {};
};

Painting make_painting(const PaintingTask& task);

/// The levels that isolines are wanted of: none if the look has none or values are not blended.
std::vector<IsoLevel> wanted_levels(const Painting& painting, const Look& look);
/// Isolines of these levels in a scene of this size, m.
Isolines painted_isolines(const Painting& painting, const BlendedTriangles& field,
                          const std::vector<IsoLevel>& levels, const HiddenSurfaces& hidden,
                          double size);

/// 8-bit sRGB of points of a painting without legend, from their linear sRGB, m x 3.
std::vector<io::Rgb> point_colors(const Painting& painting, const Eigen::MatrixXd& values);
/// Places on the colour map in (0, 1) of points of a painting with a legend, from their values,
/// m x 1; -1 where nothing is known.
std::vector<float> map_positions(const Painting& painting, const Eigen::MatrixXd& values);

/// Linear sRGB of patches' values in any bands, n x 3.
Eigen::MatrixX3f display_colors(const Eigen::MatrixXd& values, const radiosity::Bands& bands);
/// Linear sRGB in [0, 1] of surfaces of that reflectance (n x b) in a light in which one that
/// reflects all is white, n x 3.
Eigen::MatrixX3f surface_colors(const Eigen::MatrixXd& reflectance, const radiosity::Bands& bands);

}  // namespace viewer
