#include "radiosity/exchange/point_factors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <mutex>
#include <vector>

#include "radiosity/base/parallel.h"
#include "radiosity/polygon/convex_polygon.h"
#include "radiosity/scene/whole_mesh.h"
#include "radiosity/visibility/occluders.h"
#include "radiosity/visibility/visible_polygon.h"

namespace radiosity {
namespace {

/// An element this close to a patch, relative to the scene's size, and this parallel to it, lies on
/// it: points are given with few digits.
constexpr double kTouching = 1e-6;
constexpr double kParallel = 1 - 1e-6;

/// The hemisphere's four quadrants are halved so often before they are shared among threads.
constexpr int kSharedHalvings = 3;
constexpr int kSharedCells = 4 << kSharedHalvings;
/// A cell with so few patches is not divided.
constexpr std::size_t kFewPatches = 16;
/// Cells halved more often than this are content with more patches: what they hold are silhouettes,
/// which further halving only follows.
constexpr int kSmallCell = 8;

/// A patch as the point sees it; coordinates are relative to the point.
struct SeenPatch {
  Occluder occluder;     // normal towards the point
  std::int32_t surface;  // -1: its back is seen

  [[nodiscard]] double height(const Vec3& x) const {
    return occluder.normal.dot(x) - occluder.offset;
  }
};

/// The directions between three, counter-clockwise as seen from outside, unit.
using Cell = std::array<Vec3, 3>;

/// A patch's part in a cell.
struct Piece {
  std::int32_t patch;
  ConvexPolygon polygon;
};

ConvexPolygon clip_to_cell(std::span<const Vec3> polygon, const Cell& cell) {
  std::array<Vec3, 3> inwards;
  for (int k = 0; k < 3; ++k) {
    inwards[k] = cell[k].cross(cell[(k + 1) % 3]);
    const bool is_outside = std::all_of(polygon.begin(), polygon.end(),
                                        [&](const Vec3& x) { return inwards[k].dot(x) <= 0; });
    if (is_outside) return {};
  }
  ConvexPolygon rest(polygon);
  for (const Vec3& normal : inwards) {
    rest = clip_to_half_space(rest.points(), Vec3::Zero(), normal, 0);
  }
  return rest;
}

std::array<Cell, 2> halves(const Cell& cell) {
  int k = 0;  // the longest side runs from corner k
  for (int other = 1; other < 3; ++other) {
    const double longest = (cell[(k + 1) % 3] - cell[k]).squaredNorm();
    if ((cell[(other + 1) % 3] - cell[other]).squaredNorm() > longest) k = other;
  }
  const Vec3& a = cell[k];
  const Vec3& b = cell[(k + 1) % 3];
  const Vec3& c = cell[(k + 2) % 3];
  const Vec3 middle = (a + b).normalized();
  return {Cell{a, middle, c}, Cell{middle, b, c}};
}

std::vector<Cell> shared_cells(const Vec3& normal) {
  const Vec3 u = normal.unitOrthogonal();
  const Vec3 v = normal.cross(u);
  std::vector<Cell> cells = {{u, v, normal}, {v, -u, normal}, {-u, -v, normal}, {-v, u, normal}};
  for (int k = 0; k < kSharedHalvings; ++k) {
    std::vector<Cell> finer;
    for (const Cell& cell : cells) {
      for (const Cell& half : halves(cell)) finer.push_back(half);
    }
    cells = std::move(finer);
  }
  return cells;
}

class View {
 public:
  View(const PatchMesh& mesh, const Vec3& point, const Vec3& normal, const Progress& progress)
      : normal_(normal),
        n_surfaces_(static_cast<Index>(mesh.surface_names.size())),
        progress_(progress) {
    const Box3 box = bounds(mesh).extend(point);
    thickness_ = std::max(plane_thickness(box), plane_thickness(mesh));
    touching_ = kTouching * box.diagonal().norm();
    for (Index i = 0; i < mesh.size(); ++i) add_patch(mesh, i, point);
  }

  Destinations divide() {
    const std::vector<Cell> cells = shared_cells(normal_);
    std::vector<Piece> all;
    for (std::size_t k = 0; k < patches_.size(); ++k) {
      all.push_back({static_cast<std::int32_t>(k), {}});
    }
    std::vector<Destinations> parts(cells.size());
    parallel_for(static_cast<std::ptrdiff_t>(cells.size()), [&](std::ptrdiff_t k) {
      parts[k].surfaces = Eigen::VectorXd::Zero(n_surfaces_);
      visit(cells[k], all, kSharedHalvings, parts[k]);
      tell_progress();
    });
    Destinations sum{Eigen::VectorXd::Zero(n_surfaces_)};
    for (const Destinations& part : parts) {
      sum.surfaces += part.surfaces;
      sum.backs += part.backs;
      sum.sky += part.sky;
    }
    return sum;
  }

 private:
  void add_patch(const PatchMesh& mesh, Index i, const Vec3& point) {
    double distance = mesh.normal[i].dot(point - mesh.centroid[i]);
    const bool is_back = distance < 0;
    distance = std::abs(distance);
    if (distance <= thickness_ || (is_back && mesh.twin[i] >= 0)) return;
    if (distance <= touching_ && lies_on(mesh, i, point)) return;
    // Backs stand a little further away, in the same directions: behind fronts in their plane.
    const double scale = is_back ? 1 + 3 * thickness_ / distance : 1;
    SeenPatch seen{{}, is_back ? -1 : mesh.surface[i]};
    for (int k = 0; k < mesh.n_corners(i); ++k) {
      seen.occluder.corners.push_back(scale * (mesh.corner(i, k) - point));
      seen.occluder.box.extend(seen.occluder.corners.back());
      reach_ = std::max(reach_, seen.occluder.corners.back().norm());
    }
    if (is_back) std::reverse(seen.occluder.corners.begin(), seen.occluder.corners.end());
    seen.occluder.normal = is_back ? Vec3(-mesh.normal[i]) : mesh.normal[i];
    seen.occluder.offset = -scale * distance;
    patches_.push_back(std::move(seen));
  }

  /// Whether the element is a part of the patch, or of its twin, but for rounding.
  [[nodiscard]] bool lies_on(const PatchMesh& mesh, Index i, const Vec3& point) const {
    const double cosine = mesh.normal[i].dot(normal_);
    if ((mesh.twin[i] < 0 ? cosine : std::abs(cosine)) < kParallel) return false;
    for (int k = 0; k < mesh.n_corners(i); ++k) {
      const Vec3& a = mesh.corner(i, k);
      const Vec3 edge = mesh.corner(i, (k + 1) % mesh.n_corners(i)) - a;
      if (mesh.normal[i].cross(edge).dot(point - a) < -touching_ * edge.norm()) return false;
    }
    return true;
  }

  void visit(const Cell& cell, const std::vector<Piece>& candidates, int halvings,
             Destinations& sum) const {
    progress_.check();
    const std::vector<Piece> pieces = visible_parts(cell, candidates);
    const int extra = std::max(0, halvings - kSmallCell) / 2;
    if (pieces.size() <= kFewPatches << static_cast<unsigned>(extra)) {
      add_shares(cell, pieces, sum);
      return;
    }
    for (const Cell& half : halves(cell)) visit(half, pieces, halvings + 1, sum);
  }

  /// The candidates' parts in the cell but for those behind the first patch that fills it.
  [[nodiscard]] std::vector<Piece> visible_parts(const Cell& cell,
                                                 const std::vector<Piece>& candidates) const {
    const Vec3 middle = cell[0] + cell[1] + cell[2];
    std::vector<Piece> pieces;
    std::int32_t filler = -1;
    double nearest = std::numeric_limits<double>::infinity();
    for (const Piece& candidate : candidates) {
      const SeenPatch& patch = patches_[candidate.patch];
      const ConvexPolygon polygon = clip_to_cell(patch.occluder.corners, cell);
      if (polygon.empty()) continue;
      pieces.push_back({candidate.patch, polygon});
      const double distance = patch.occluder.offset / patch.occluder.normal.dot(middle);
      if (distance < nearest && fills(patch, cell)) {
        filler = candidate.patch;
        nearest = distance;
      }
    }
    if (filler >= 0) {
      // Quads need not be planar to the last digit, so that one may lie behind its own plane.
      std::erase_if(pieces, [&](const Piece& piece) {
        return piece.patch != filler && is_behind(piece, patches_[filler]);
      });
    }
    return pieces;
  }

  [[nodiscard]] static bool fills(const SeenPatch& patch, const Cell& cell) {
    const std::vector<Vec3>& corners = patch.occluder.corners;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const Vec3 inwards = corners[k + 1 < corners.size() ? k + 1 : 0].cross(corners[k]);
      for (const Vec3& direction : cell) {
        if (inwards.dot(direction) < 0) return false;
      }
    }
    return true;
  }

  /// Whether all of the piece lies behind the patch's plane.
  [[nodiscard]] bool is_behind(const Piece& piece, const SeenPatch& patch) const {
    return std::all_of(piece.polygon.begin(), piece.polygon.end(),
                       [&](const Vec3& corner) { return patch.height(corner) < -thickness_; });
  }

  /// Whether some of the piece does.
  [[nodiscard]] bool reaches_behind(const Piece& piece, const SeenPatch& patch) const {
    return std::any_of(piece.polygon.begin(), piece.polygon.end(),
                       [&](const Vec3& corner) { return patch.height(corner) < -thickness_; });
  }

  void add_shares(const Cell& cell, const std::vector<Piece>& pieces, Destinations& sum) const {
    std::vector<const Occluder*> occluders;
    const auto share = [&](const ConvexPolygon& target) {
      return visible_point_to_polygon(Vec3::Zero(), normal_, target, occluders, thickness_);
    };
    for (const Piece& piece : pieces) {
      occluders.clear();
      for (const Piece& other : pieces) {
        const SeenPatch& patch = patches_[other.patch];
        if (other.patch != piece.patch && reaches_behind(piece, patch)) {
          occluders.push_back(&patch.occluder);
        }
      }
      const std::int32_t surface = patches_[piece.patch].surface;
      (surface < 0 ? sum.backs : sum.surfaces[surface]) += share(piece.polygon);
    }
    occluders.clear();
    for (const Piece& piece : pieces) occluders.push_back(&patches_[piece.patch].occluder);
    // Beyond everything, although the middle of the largest cell is nearer than its corners.
    const double far = patches_.empty() ? 1 : 4 * reach_;
    ConvexPolygon sky;
    for (int k = 2; k >= 0; --k) sky.push_back(far * cell[k]);
    sum.sky += share(sky);
  }

  void tell_progress() {
    const std::lock_guard lock(mutex_);
    ++n_done_;
    if (progress_.report) progress_.report("factors", n_done_, kSharedCells, "parts of the view");
  }

  const Vec3 normal_;
  const Index n_surfaces_;
  const Progress& progress_;
  double thickness_ = 0;
  double touching_ = 0;
  double reach_ = 0;  // distance of the furthest corner
  std::vector<SeenPatch> patches_;
  std::mutex mutex_;  // guards n_done_
  int n_done_ = 0;
};

}  // namespace

Destinations point_factors(const PatchMesh& mesh, const Vec3& point, const Vec3& normal,
                           const Progress& progress) {
  const WholeMesh whole(mesh);
  return View(whole.mesh(), point, normal, progress).divide();
}

}  // namespace radiosity
