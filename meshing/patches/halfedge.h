#pragma once

#include <limits>
#include <span>
#include <vector>

#include "meshing/base/triangulate.h"
#include "radiosity/base/progress.h"

namespace meshing {

/// A polygon in a plane whose edges are divided into pieces that must stay as they are.
struct DividedPolygon {
  std::vector<Vec2> boundary;         ///< corners and division points, counter-clockwise
  std::vector<std::int32_t> corners;  ///< indices into `boundary`, increasing
  std::vector<Triangle> triangles;    ///< a triangulation of the corners: indices into `corners`
};

/// Triangles in a plane.
struct PlanarMesh {
  std::vector<Vec2> points;
  std::vector<Triangle> triangles;  ///< indices into `points`, counter-clockwise
};

/// Flips the edges of a triangulated polygon until it is constrained Delaunay: of all its
/// triangulations without new points the one with the largest smallest angle. Needs `triangles` to
/// be manifold and counter-clockwise.
std::vector<Triangle> make_delaunay(std::span<const Vec2> points,
                                    std::span<const Triangle> triangles);

/// Fills a polygon with well-shaped triangles: constrained Delaunay refinement (Chew, "Guaranteed-
/// quality triangular meshes", 1989; Ruppert, J. Algorithms 18, 1995) with points inside only, so
/// the boundary stays as divided. No edge inside is longer than `max_edge`; angles are above 28
/// degrees except where the boundary forces smaller ones. The first points of the result are the
/// boundary. `progress` is told how many triangles
/// there are, each once more as they are smoothed. Throws Interrupted.
PlanarMesh refine(const DividedPolygon& polygon, double max_edge,
                  const radiosity::Progress& progress = {});

}  // namespace meshing
