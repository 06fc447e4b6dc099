#pragma once

#include <Eigen/Core>
#include <deque>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "radiosity/base/geometry.h"
#include "radiosity/picture/gather_interpolation.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/visibility/cluster_visibility.h"
#include "radiosity/visibility/prepared_mesh.h"
#include "radiosity/visibility/segment_bundle.h"
#include "radiosity/visibility/visible_polygon.h"

namespace radiosity {

/// What all gathering shares. Coordinates are relative to the scene's centre.
struct GatherScene : PreparedMesh {
  /// `radiosity` is n_patches x n_bands, W/m².
  GatherScene(const PatchMesh& mesh, const Eigen::MatrixXd& radiosity);

  Eigen::MatrixXd radiosity;  ///< n_bands x n_patches, W/m²
  std::vector<bool> is_dark;  ///< per patch: it has none
};

/// A point of a group and the column of its irradiance.
struct GatherPoint {
  Vec3 position;  ///< relative to the scene's centre, m
  Index column;
};

/// Gathers light at points in one plane. The cluster tree of patches is walked once for all of them
/// with inherited blockers, as for exchange areas; then the points are halved again and again, and
/// patches that are not proved visible or hidden are looked at anew from each half. What is left
/// for a few points is clipped exactly. Keeps its memory from call to call; not to be shared by
/// threads.
class PointGather {
 public:
  explicit PointGather(const GatherScene& scene) : scene_(scene) {}

  /// Adds the irradiance of the points, which are reordered, to their columns, n_bands rows.
  void gather(const HalfSpace& plane, std::span<GatherPoint> points, Eigen::MatrixXd& irradiance);

  /// Takes the number of a patch and a convex part of it.
  using PieceVisitor = std::function<void(std::int32_t patch, std::span<const Vec3> piece)>;
  /// Visits all that a single point of the plane sees in front of it of patches that are not dark.
  void visit(const HalfSpace& plane, const Vec3& point, const PieceVisitor& visitor);

 private:
  /// A patch, or its part in front of the points, and what may hide it: a range of a level's
  /// blockers.
  struct Target {
    std::int32_t patch;
    std::int32_t clipped;  // index into clipped_, or -1: the whole patch
    std::size_t first_blocker;
    std::size_t n_blockers;
  };
  /// Patches that are neither proved visible nor hidden at a depth of the division.
  struct Level {
    std::vector<Target> targets;
    Candidates blockers;
  };
  /// The points under way: their hull stands for them.
  struct Source {
    std::span<GatherPoint> points;
    std::vector<Vec3> outline;
    Rectangle rectangle;
  };
  /// Irradiance at the nodes of a rectangle, if the order is used.
  struct Nodes {
    std::optional<RectangleInterpolation> interpolation;
    Eigen::MatrixXd irradiance;
  };

  [[nodiscard]] Source make_source(std::span<GatherPoint> points) const;
  void walk(const Cluster& source_cluster, std::int32_t cluster, const Candidates& candidates,
            const Source& source);
  void add_patch(std::int32_t patch, const Candidates& candidates, const Source& source);
  /// Adds what the points see of a level's targets, and divides them where that is not proved.
  void resolve(const Source& source, std::size_t depth);
  /// The halves of the points along their rectangle.
  static std::array<std::span<GatherPoint>, 2> halved(const Source& source);
  /// Finds the blockers that are not proved away, and for few points their shadows.
  Blocking find_open(const ConvexPolygon& target, std::span<const std::int32_t> blockers,
                     const Source& source);
  Shadow& next_shadow();
  void add_visible(const Target& target, const Source& source);
  void add_partial(const Target& target, const Source& source);
  void interpolate(const Source& source);
  void add(std::int32_t patch, double factor, Index column);
  [[nodiscard]] const ConvexPolygon& polygon(const Target& target) const;
  [[nodiscard]] bool is_behind(const Vec3& point, std::int32_t patch) const;

  const GatherScene& scene_;
  HalfSpace plane_{};
  Eigen::MatrixXd* irradiance_ = nullptr;
  const PieceVisitor* visitor_ = nullptr;  // takes the pieces in place of the irradiance
  std::vector<ConvexPolygon> clipped_;
  std::deque<Level> levels_;  // does not move them as it grows
  std::array<Nodes, RectangleInterpolation::kLargestOrder + 1> nodes_;
  std::vector<Shadow> shadows_;  // the first n_shadows_ are in use
  std::size_t n_shadows_ = 0;
  Candidates open_;            // blockers that stay between the points and a target
  Candidates point_by_point_;  // of these: whose shadow has to be found for each point
  ShadowCutter cutter_;
};

}  // namespace radiosity
