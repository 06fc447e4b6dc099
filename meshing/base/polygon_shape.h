#pragma once

#include <cstdint>
#include <span>

#include "radiosity/base/geometry.h"

namespace meshing {

/// Largest distance of a quad's corner from the plane of the others, relative to its diagonal, up
/// to which it counts as planar; a quad further from planar becomes two triangles, unless it may be
/// planar but for the precision of its coordinates (Scene::precision).
inline constexpr double kPlanarQuad = 1e-6;

/// Area relative to the squared extent of a polygon up to which it counts as having none.
inline constexpr double kZeroArea = 1e-10;

/// What kind of polygon this is, as far as subdivision is concerned.
enum class PolygonKind : std::uint8_t {
  zero_area,      ///< fewer than three corners, or all of them (nearly) on one line
  self_crossing,  ///< seen for quads; larger polygons show it when they are triangulated
  triangle,
  planar_quad,         ///< convex; a corner of 180 degrees is allowed
  non_planar_quad,     ///< convex as seen along its normal
  planar_polygon,      ///< five corners or more, or a concave quad
  non_planar_polygon,  ///< likewise
};

/// Measures of one polygon.
struct PolygonShape {
  PolygonKind kind = PolygonKind::zero_area;
  radiosity::Vec3 vector_area = radiosity::Vec3::Zero();  ///< m², see radiosity::vector_area
  double extent = 0;                                      ///< diagonal of its bounding box, m
  double deviation = 0;  ///< from planar, m: for a quad see kPlanarQuad, else from the mean plane
};

/// Examines a polygon without repeated consecutive corners, whose coordinates may be off by
/// `precision`, m: it is planar if it may have been meant to be.
PolygonShape polygon_shape(std::span<const radiosity::Vec3> polygon, double precision);

/// Largest distance of a corner of a quad from the plane of the other three, m. Corners whose
/// other three lie nearly on a line are left out, since those have no plane.
double quad_deviation(std::span<const radiosity::Vec3> quad);

}  // namespace meshing
