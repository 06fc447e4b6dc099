#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "radiosity/base/geometry.h"
#include "viewer/desk/hidden_surfaces.h"
#include "viewer/desk/legend.h"
#include "viewer/desk/surface_line.h"

namespace viewer {

/// A value that lines of equal value are drawn of.
struct IsoLevel {
  double value = 0;
  double position = 0;  ///< on the legend's scale, in (0, 1)
};

/// The legend's ticks, but for those at the ends of its scale, beyond which all has one colour.
std::vector<IsoLevel> iso_levels(const Legend& legend);

/// 8-bit sRGB of a line at that position of a colour map: light where the map is dark.
io::Rgb isoline_color(double position, io::ColorMap map);

/// Corners of triangles with what is blended between them.
struct BlendedTriangles {
  std::span<const radiosity::Vec3> points = {};  ///< m
  std::span<const std::array<std::int32_t, 3>> triangles =
      {};                                       ///< counter-clockwise from the front
  std::span<const std::int32_t> surfaces = {};  ///< per triangle
  std::span<const float> positions = {};  ///< per point, on the colour map; negative: not known
};

/// A number on an isoline.
struct IsoNumber {
  double value = 0;
  radiosity::Vec3 place = radiosity::Vec3::Zero();  ///< m
};

/// Lines of equal value, a piece for each triangle that they cross; pieces meet where values do.
struct Isolines {
  std::vector<SurfaceLine> lines;
  std::vector<IsoNumber> numbers;  ///< apart from each other
};

/// Isolines of these levels on surfaces that are not hidden. Numbers of one level stand `spacing`
/// (m) apart, of two a fifth of it.
Isolines make_isolines(const BlendedTriangles& field, std::span<const IsoLevel> levels,
                       io::ColorMap map, const HiddenSurfaces& hidden, double spacing);

}  // namespace viewer
