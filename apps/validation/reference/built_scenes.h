#pragma once

#include <string>
#include <vector>

#include "radiosity/base/geometry.h"
#include "radiosity/scene/scene.h"

namespace apps::validation {

/// Corners in order, counter-clockwise about the emitting side, m.
using Polygon = std::vector<radiosity::Vec3>;

enum class Facing { inwards, outwards };

/// A grey material: reflectance, and temperature (K) or exitance (W/m²) where above 0.
struct Grey {
  double reflectance = 0;
  double exitance = 0;
  double temperature = 0;
  bool two_sided = false;  ///< of the surface
};

/// A scene of one grey band without surfaces.
radiosity::Scene empty_scene(const std::string& name);

/// Appends a surface with a material of its own. Returns its index.
std::int32_t add_surface(radiosity::Scene& scene, const std::string& name,
                         const std::vector<Polygon>& polygons, const Grey& grey = {});

/// The parallelogram a + s u + t v, s, t in [0, 1], facing u x v.
Polygon parallelogram(const radiosity::Vec3& a, const radiosity::Vec3& u, const radiosity::Vec3& v);

/// The faces of a box: -z, +z, -x, +x, -y, +y.
std::vector<Polygon> box_faces(const radiosity::Vec3& low, const radiosity::Vec3& high,
                               Facing facing);

/// A regular polygon about the z axis at height z, with a corner at (radius, 0, z), facing up
/// or down.
Polygon regular_polygon(int n, double radius, double z, bool faces_up);

/// The faces of a right prism over an upward-facing polygon, seen from inside: base, top, sides.
std::vector<Polygon> prism_inside(const Polygon& base, double height);

/// An icosahedron whose faces are divided in four `level` times, all corners on the sphere about
/// the origin: 20 * 4^level triangles.
std::vector<Polygon> icosphere(int level, double radius, Facing facing);

}  // namespace apps::validation
