#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "radiosity/scene/scene.h"

namespace radiosity::test {

/// What a polygon is part of.
enum class Piece : std::uint8_t {
  sheet,  ///< nothing closed
  solid,  ///< a closed surface that faces outwards: matter inside
  hollow  ///< a closed surface that faces inwards: a room
};

/// A scene and what its maker knows about it. All polygons are convex.
struct FamilyScene {
  Scene scene;
  std::string name;           ///< family, seed and how it was varied
  std::vector<Piece> pieces;  ///< per polygon
  /// No ray from an uncovered point of a front escapes or meets a back.
  bool is_closed = false;
  double precision = 0;  ///< half a unit of the coordinates' last digit, m; 0 = of a double
};

/// Kinds of scenes that people have.
enum class Family : std::uint8_t {
  plates,        ///< stacks of plates: one-sided, two-sided, thin solids
  storeys,       ///< rooms above and beside each other, with walls thick, thin and back to back
  lamps,         ///< panels just below a ceiling
  shelves,       ///< boards that end on panels, on both sides of a divider
  stacks,        ///< boxes upon each other, legs and tops, walls on floors
  grid_boxes,    ///< boxes of an integer grid: they touch by faces, edges and corners
  turned_boxes,  ///< boxes turned any way in a room
  prisms,        ///< upright prisms and plates of 3 to 96 sides
  recessed,      ///< closed solids that are not convex: L, U, T and rings
  curved,        ///< spheres and bumpy closed meshes of triangles
  furniture,     ///< tables, chairs and rooms that are closed, but not convex
  crossing,      ///< polygons that pass through each other, needles among them
  canyon,        ///< streets between buildings, open
  louvres,       ///< many slats side by side, turned alike
  stairs,        ///< closed solids with steps, on floors and walls
  pipes,         ///< slim prisms any way, some lying on a floor by an edge
  windows,       ///< walls of parts around openings, with reveals and frames
  wedges,        ///< pyramids and wedges whose slanted faces touch
  nested         ///< shells of boxes within boxes, closed or with a slit
};
inline constexpr std::array kFamilies{
    Family::plates,     Family::storeys,      Family::lamps,  Family::shelves,  Family::stacks,
    Family::grid_boxes, Family::turned_boxes, Family::prisms, Family::recessed, Family::curved,
    Family::furniture,  Family::crossing,     Family::canyon, Family::louvres,  Family::stairs,
    Family::pipes,      Family::windows,      Family::wedges, Family::nested};
std::string_view family_name(Family family);

/// A scene of some 1 m to 2 m, with coordinates up to 1 m but for rounding.
FamilyScene make_family_scene(Family family, std::uint64_t seed);

}  // namespace radiosity::test
