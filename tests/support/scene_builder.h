#pragma once

#include <string>
#include <vector>

#include "tests/support/scene_families.h"
#include "tests/support/scene_random.h"

namespace radiosity::test {

using Points = std::vector<Vec3>;
enum class Division { one_surface, surface_per_face };

/// Puts a family's scene together, polygon by polygon.
class Builder {
 public:
  std::int32_t add_surface(const std::string& name, bool two_sided = false);
  void add_polygon(std::int32_t surface, const Points& points, Piece piece = Piece::sheet);
  /// The polygons of a closed piece, each one or all together a surface.
  void add_piece(const std::string& name, const std::vector<Points>& polygons, Piece piece,
                 Division division);
  void add_box(const std::string& name, const Vec3& low, const Vec3& high, Division division,
               Piece piece = Piece::solid);

  FamilyScene result;
};

/// Faces of a box, counter-clockwise from outside: -x, +x, -y, +y, -z, +z.
std::vector<Points> box_faces(const Vec3& low, const Vec3& high);
/// Faces of an upright prism on a convex bottom, counter-clockwise seen from above.
std::vector<Points> prism_faces(const Points& bottom, const Vec3& up);
void turn_over(std::vector<Points>& polygons);
Division any_division(Random& random);
Points rectangle(double x0, double x1, double y0, double y1, double z);
Points regular_polygon(int n, double radius, const Vec3& center, double phase);
Points reversed(Points points);
/// A room of about 2 m around the origin. Half of all are of one surface per wall.
void add_room(Builder& builder, Random& random, Vec3& low, Vec3& high);

/// A plate at a height: one-sided, facing up (0) or down (1), two-sided (2), or a thin solid (3).
void add_plate(Builder& builder, Random& random, int kind, double x0, double x1, double y0,
               double y1, double z);

/// The families of closed solids, in solid_families.cpp.
void make_grid_boxes(Builder& builder, Random& random);
void make_turned_boxes(Builder& builder, Random& random);
void make_prisms(Builder& builder, Random& random);
void make_recessed(Builder& builder, Random& random);
void make_curved(Builder& builder, Random& random);
void make_furniture(Builder& builder, Random& random);

/// The families of buildings and their parts, in building_families.cpp.
void make_louvres(Builder& builder, Random& random);
void make_stairs(Builder& builder, Random& random);
void make_pipes(Builder& builder, Random& random);
void make_windows(Builder& builder, Random& random);
void make_wedges(Builder& builder, Random& random);
void make_nested(Builder& builder, Random& random);

}  // namespace radiosity::test
