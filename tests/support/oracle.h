#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <random>
#include <span>
#include <vector>

#include "radiosity/base/geometry.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/scene/scene.h"
#include "tests/support/ray_shapes.h"
#include "tests/support/scene_families.h"

namespace radiosity::test {

/// What is between two points. `grazing`: too close to call with the digits of the input.
enum class Sight : std::uint8_t { free, blocked, grazing };

/// Whether a point of a patch lies under a face of a closed solid that touches the patch.
enum class Cover : std::uint8_t { no, yes, border };

/// Which share of the rays from one surface ends where.
struct RayCounts {
  std::int64_t n_rays = 0;
  std::vector<std::int64_t> fronts;  ///< per surface: met its front
  std::int64_t backs = 0;            ///< met a back first
  std::int64_t covered = 0;          ///< started at a covered point, or ended at one
  std::int64_t escaped = 0;
};

/// Visibility by brute force in double precision: every polygon of the scene is looked at, whatever
/// patches it is divided into. A polygon blocks from both sides; those in the plane of an end do
/// not block there. Covered points see nothing. Points are relative to `center()`. Knows nothing of
/// the code that it judges.
class Oracle {
 public:
  /// The patches of the scene, to be named by index. Polygons must be convex.
  Oracle(const FamilyScene& family_scene, const PatchMesh& mesh);

  [[nodiscard]] const Vec3& center() const { return center_; }

  /// A point of a patch, evenly distributed.
  [[nodiscard]] Vec3 random_point(Index patch, std::mt19937_64& random) const;

  /// How far a point lies in front of a patch's plane, beyond what digits leave open, m; below 0
  /// if it is behind or too close to call.
  [[nodiscard]] double height(Index patch, const Vec3& point) const;

  /// What is between x on patch i and y on patch j. Covers are not looked at.
  [[nodiscard]] Sight sight(Index i, const Vec3& x, Index j, const Vec3& y) const;

  [[nodiscard]] Cover cover(Index patch, const Vec3& point) const;

  /// Share of a patch's area that is covered.
  [[nodiscard]] double covered_share(Index patch) const;

  /// The same, with the contact of a solid's face and a room's wall counted as cover: nothing that
  /// is in the room sees such a face.
  [[nodiscard]] double contact_share(Index patch) const;

  /// First hits of n_rays cosine-distributed rays from evenly distributed points of a surface.
  [[nodiscard]] RayCounts shoot(std::int32_t surface, std::int64_t n_rays,
                                std::uint64_t seed) const;

  /// How far coordinates may be off, m.
  [[nodiscard]] double thickness() const { return thickness_; }
  /// Smallest width of the polygon that a patch is part of, m.
  [[nodiscard]] double polygon_width(Index patch) const {
    return faces_[mesh_.polygon[patch]].width;
  }

 private:
  struct Face {
    Vec3 center;
    Vec3 normal;
    double off_plane;  // how far corners are off the plane, m
    double width;      // least extent in the plane, m
    double area;
    std::int32_t surface;
    bool two_sided;
    Piece piece;
    std::vector<Vec3> corners;
    std::vector<Vec3> inwards;           // per edge: unit normal in the plane
    std::vector<double> edge_length;     // m
    std::vector<std::int32_t> coplanar;  // other faces in its plane
  };
  void add_face(const Scene& scene, Index polygon, Piece piece);
  void add_shapes(std::int32_t face);
  void find_coplanar();
  [[nodiscard]] double slack(const Face& face, const Vec3& a, const Vec3& b) const;
  [[nodiscard]] Sight sight_past(const Face& face, const Vec3& x, const Vec3& y) const;
  [[nodiscard]] Cover position_in(const Face& face, const Vec3& point) const;
  [[nodiscard]] double overlap(Index patch, const Face& face) const;
  template <class Predicate>
  [[nodiscard]] double share(Index patch, const Predicate& is_cover) const;
  struct Arrival;
  void shoot_from(std::int32_t face, bool is_back, std::int64_t n_rays, std::mt19937_64& random,
                  RayCounts& counts) const;

  const PatchMesh& mesh_;
  Vec3 center_ = Vec3::Zero();
  double thickness_ = 0;
  double margin_ = 0;
  std::vector<Face> faces_;  // per polygon
  RayShapes shapes_;
};

}  // namespace radiosity::test
