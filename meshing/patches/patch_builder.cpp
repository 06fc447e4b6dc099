#include "meshing/patches/patch_builder.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <exception>
#include <span>
#include <utility>

#include "meshing/base/polygon_shape.h"
#include "meshing/base/text.h"
#include "meshing/patches/halfedge.h"
#include "meshing/patches/polygon_cell.h"
#include "meshing/patches/shared_progress.h"
#include "radiosity/base/error.h"
#include "radiosity/base/parallel.h"

namespace meshing {
namespace {

using radiosity::Index;
using radiosity::PatchMesh;
using radiosity::Vec3;

/// The triangles that fill a polygon, or why they could not be made.
struct Filling {
  PlanarMesh triangles;
  std::exception_ptr error;
};

/// A divided line inside a polygon that two of its triangles share.
struct Diagonal {
  std::int32_t from, to, first_point, n_pieces;
};

class PatchBuilder {
 public:
  PatchBuilder(const radiosity::Scene& scene, const Topology& topology,
               const EdgeDivision& division, const radiosity::Progress& progress)
      : scene_(scene),
        topology_(topology),
        division_(division),
        count_(count_patches(scene, topology, division)),
        progress_(progress, "dividing", count_.certain + 2 * count_.estimated, "steps") {}

  PatchMesh run();

 private:
  std::int32_t add_division_points(std::int32_t from, std::int32_t to, std::int32_t n_pieces);
  void reserve();
  void divide_edges();
  void append_edge(std::int64_t corner, PolygonCell& cell) const;
  void append_diagonal(std::int32_t from, std::int32_t to);
  [[nodiscard]] PolygonCell cell_of(Index polygon) const;
  [[nodiscard]] std::vector<Vec3> corner_positions(const PolygonCell& cell) const;
  [[nodiscard]] bool is_filled(Index polygon, const PolygonCell& cell) const;
  void fill_polygons();
  [[nodiscard]] PlanarMesh filling(Index polygon, const PolygonCell& cell,
                                   const radiosity::Progress& progress) const;

  void build_polygon();
  void build_grid();
  void build_triangle_grid();
  void build_filled();
  void build_triangles(std::span<const Triangle> triangles);
  [[nodiscard]] std::vector<Triangle> triangulate_corners(Index polygon,
                                                          const PolygonCell& cell) const;
  void add_patch(const std::array<std::int32_t, 4>& corners);

  [[nodiscard]] const Vec3& at(std::int32_t vertex) const { return mesh_.vertices[vertex]; }

  const radiosity::Scene& scene_;
  const Topology& topology_;
  const EdgeDivision& division_;
  PatchCount count_;
  SharedProgress progress_;
  PatchMesh mesh_;
  std::vector<std::int32_t> first_point_;  // per edge: its division points from ends[0] on
  std::vector<Filling> fillings_;          // per polygon, if any is filled
  Index polygon_ = 0;
  PolygonCell cell_;
  std::vector<Diagonal> diagonals_;
};

PatchMesh PatchBuilder::run() {
  for (const radiosity::Surface& s : scene_.surfaces) {
    mesh_.surface_names.push_back(s.name);
    mesh_.surface_two_sided.push_back(s.two_sided);
  }
  mesh_.vertices = topology_.polygons.vertices;
  mesh_.precision = scene_.precision;
  mesh_.first_polygon_corner = topology_.polygons.first_corner;
  mesh_.polygon_corners.reserve(topology_.polygons.corners.size());
  for (const std::int32_t v : topology_.polygons.corners) {
    mesh_.polygon_corners.push_back(mesh_.vertices[v]);
  }
  reserve();
  divide_edges();
  fill_polygons();
  for (; polygon_ < topology_.polygons.size(); ++polygon_) {
    if (polygon_ % 4096 == 0) progress_.check();
    cell_ = cell_of(polygon_);
    const Index n_before = mesh_.size();
    const bool is_told = is_filled(polygon_, cell_);
    build_polygon();
    if (!is_told) progress_.add(static_cast<double>(mesh_.size() - n_before));
  }
  return std::move(mesh_);
}

void PatchBuilder::reserve() {
  mesh_.reserve(static_cast<Index>(count_.certain + count_.estimated));
}

std::int32_t PatchBuilder::add_division_points(std::int32_t from, std::int32_t to,
                                               std::int32_t n_pieces) {
  const auto first = static_cast<std::int32_t>(mesh_.vertices.size());
  const Vec3 start = at(from);
  const Vec3 step = at(to) - start;
  for (std::int32_t k = 1; k < n_pieces; ++k) {
    mesh_.vertices.emplace_back(start + static_cast<double>(k) / n_pieces * step);
  }
  return first;
}

void PatchBuilder::divide_edges() {
  const EdgeTable& edges = topology_.edges;
  first_point_.resize(edges.size());
  for (Index e = 0; e < edges.size(); ++e) {
    first_point_[e] =
        add_division_points(edges.ends[e][0], edges.ends[e][1], division_.n_pieces[e]);
  }
}

/// Appends the start and the division points of a corner's edge to the cell.
void PatchBuilder::append_edge(std::int64_t corner, PolygonCell& cell) const {
  const std::int32_t e = topology_.edges.edge_of_corner[corner];
  const std::int32_t start = topology_.polygons.corners[corner];
  const std::int32_t n_inside = division_.n_pieces[e] - 1;
  const bool is_forward = start == topology_.edges.ends[e][0];
  cell.corners.push_back(static_cast<std::int32_t>(cell.boundary.size()));
  cell.boundary.push_back(start);
  for (std::int32_t k = 0; k < n_inside; ++k) {
    cell.boundary.push_back(first_point_[e] + (is_forward ? k : n_inside - 1 - k));
  }
}

/// The same for a line inside the polygon, which is divided when it is first met.
void PatchBuilder::append_diagonal(std::int32_t from, std::int32_t to) {
  const auto known = std::find_if(diagonals_.begin(), diagonals_.end(),
                                  [&](const Diagonal& d) { return d.from == to && d.to == from; });
  Diagonal d{};
  if (known == diagonals_.end()) {
    const double n = std::ceil((at(to) - at(from)).norm() / division_.max_edge * (1 - 1e-12));
    d = {from, to, 0, std::max(1, static_cast<std::int32_t>(n))};
    d.first_point = add_division_points(from, to, d.n_pieces);
    diagonals_.push_back(d);
  } else {
    d = *known;
  }
  cell_.corners.push_back(static_cast<std::int32_t>(cell_.boundary.size()));
  cell_.boundary.push_back(from);
  for (std::int32_t k = 0; k + 1 < d.n_pieces; ++k) {
    cell_.boundary.push_back(d.first_point + (from == d.from ? k : d.n_pieces - 2 - k));
  }
}

PolygonCell PatchBuilder::cell_of(Index polygon) const {
  PolygonCell cell;
  const std::vector<std::int64_t>& first = topology_.polygons.first_corner;
  for (std::int64_t c = first[polygon]; c < first[polygon + 1]; ++c) append_edge(c, cell);
  return cell;
}

std::vector<Vec3> PatchBuilder::corner_positions(const PolygonCell& cell) const {
  std::vector<Vec3> positions;
  for (const std::int32_t c : cell.corners) positions.push_back(at(cell.boundary[c]));
  return positions;
}

/// Whether a polygon as a whole is filled with triangles.
bool PatchBuilder::is_filled(Index polygon, const PolygonCell& cell) const {
  switch (topology_.kinds[polygon]) {
    case PolygonKind::triangle:
      return !cell.is_undivided() && !cell.is_evenly_divided();
    case PolygonKind::planar_quad:
      return !cell.is_undivided() && !division_.is_grid[polygon];
    case PolygonKind::planar_polygon:
      return std::isfinite(division_.max_edge);
    default:
      return false;
  }
}

/// Makes the triangles of all polygons that are filled, each by itself.
void PatchBuilder::fill_polygons() {
  std::vector<Index> filled;
  for (Index i = 0; i < topology_.polygons.size(); ++i) {
    if (is_filled(i, cell_of(i))) filled.push_back(i);
  }
  if (filled.empty()) return;
  fillings_.resize(topology_.polygons.size());
  radiosity::parallel_for(static_cast<std::ptrdiff_t>(filled.size()), [&](std::ptrdiff_t k) {
    Filling& made = fillings_[filled[k]];
    try {
      const bool has_back = scene_.surfaces[scene_.polygon_surface[filled[k]]].two_sided;
      made.triangles = filling(filled[k], cell_of(filled[k]), progress_.part(has_back ? 2 : 1));
    } catch (const radiosity::MeshError&) {
      made.error = std::current_exception();
    }
  });
}

void PatchBuilder::build_polygon() {
  if (is_filled(polygon_, cell_)) return build_filled();
  const bool is_undivided = cell_.is_undivided();
  switch (topology_.kinds[polygon_]) {
    case PolygonKind::triangle:
      return is_undivided ? add_patch({cell_.boundary[0], cell_.boundary[1], cell_.boundary[2], -1})
                          : build_triangle_grid();
    case PolygonKind::planar_quad:
      return build_grid();
    case PolygonKind::planar_polygon:
    case PolygonKind::non_planar_quad:
    case PolygonKind::non_planar_polygon:
      break;  // its triangles are divided, so that the surface is the same at any patch size
    case PolygonKind::zero_area:
    case PolygonKind::self_crossing:
      assert(false && "refused by check_polygons");
      return;
  }
  build_triangles(triangulate_corners(polygon_, cell_));
}

/// A planar quad with equally divided opposite edges.
void PatchBuilder::build_grid() {
  const std::int32_t m = cell_.n_pieces(0);
  const std::int32_t n = cell_.n_pieces(1);
  const std::array<Vec3, 4> p{at(cell_.vertex(0, 0)), at(cell_.vertex(1, 0)),
                              at(cell_.vertex(2, 0)), at(cell_.vertex(3, 0))};
  std::vector<std::int32_t> low(m + 1);
  std::vector<std::int32_t> high(m + 1);
  for (std::int32_t i = 0; i <= m; ++i) low[i] = cell_.vertex(0, i);
  for (std::int32_t j = 1; j <= n; ++j) {
    const double t = static_cast<double>(j) / n;
    for (std::int32_t i = 0; i <= m; ++i) {
      if (j == n) {
        high[i] = cell_.vertex(2, m - i);
      } else if (i == 0) {
        high[i] = cell_.vertex(3, n - j);
      } else if (i == m) {
        high[i] = cell_.vertex(1, j);
      } else {
        const double s = static_cast<double>(i) / m;
        // Relative to one corner, to keep digits far from the origin.
        const Vec3 offset =
            s * (1 - t) * (p[1] - p[0]) + s * t * (p[2] - p[0]) + (1 - s) * t * (p[3] - p[0]);
        high[i] = static_cast<std::int32_t>(mesh_.vertices.size());
        mesh_.vertices.emplace_back(p[0] + offset);
      }
    }
    for (std::int32_t i = 0; i < m; ++i) add_patch({low[i], low[i + 1], high[i + 1], high[i]});
    low.swap(high);
  }
}

/// A triangle, into n² similar ones if its edges are equally divided.
void PatchBuilder::build_triangle_grid() {
  if (!cell_.is_evenly_divided()) return build_filled();
  const std::int32_t n = cell_.n_pieces(0);
  const Vec3 a = at(cell_.vertex(0, 0));
  const Vec3 ab = at(cell_.vertex(1, 0)) - a;
  const Vec3 ac = at(cell_.vertex(2, 0)) - a;
  std::vector<std::int32_t> low(n + 1);
  std::vector<std::int32_t> high(n + 1);
  for (std::int32_t i = 0; i <= n; ++i) low[i] = cell_.vertex(0, i);
  for (std::int32_t j = 1; j <= n; ++j) {
    high[0] = cell_.vertex(2, n - j);
    high[n - j] = cell_.vertex(1, j);
    for (std::int32_t i = 1; i < n - j; ++i) {
      high[i] = static_cast<std::int32_t>(mesh_.vertices.size());
      mesh_.vertices.emplace_back(a + (i * ab + j * ac) / n);
    }
    for (std::int32_t i = 0; i <= n - j; ++i) {
      add_patch({low[i], low[i + 1], high[i], -1});
      if (i < n - j) add_patch({low[i + 1], high[i + 1], high[i], -1});
    }
    low.swap(high);
  }
}

/// Any flat polygon, or triangle of a polygon, with triangles that fit its divided edges.
void PatchBuilder::build_filled() {
  PlanarMesh filled;
  if (is_filled(polygon_, cell_)) {
    Filling& made = fillings_[polygon_];
    if (made.error) std::rethrow_exception(made.error);
    filled = std::move(made.triangles);
  } else {
    filled = filling(polygon_, cell_, {.report = {}, .stop = progress_.stop()});
  }
  const PlaneFrame frame(corner_positions(cell_));
  std::vector<std::int32_t> vertex = cell_.boundary;
  for (std::size_t k = vertex.size(); k < filled.points.size(); ++k) {
    vertex.push_back(static_cast<std::int32_t>(mesh_.vertices.size()));
    mesh_.vertices.push_back(frame.to_space(filled.points[k]));
  }
  for (const Triangle& t : filled.triangles) {
    add_patch({vertex[t[0]], vertex[t[1]], vertex[t[2]], -1});
  }
}

/// The triangles that `build_filled` makes patches of, in the plane of the cell. Throws MeshError
/// if its outline crosses itself.
PlanarMesh PatchBuilder::filling(Index polygon, const PolygonCell& cell,
                                 const radiosity::Progress& progress) const {
  const PlaneFrame frame(corner_positions(cell));
  DividedPolygon divided;
  divided.corners = cell.corners;
  divided.triangles = triangulate_corners(polygon, cell);
  for (const std::int32_t v : cell.boundary) divided.boundary.push_back(frame.to_plane(at(v)));
  const double max_edge = division_.max_edge * (1 + 1e-12) / frame.unit();
  return refine(divided, max_edge, progress);
}

/// Triangles of the polygon's corners, each divided by itself along with the diagonals.
void PatchBuilder::build_triangles(std::span<const Triangle> triangles) {
  const std::int64_t first = topology_.polygons.first_corner[polygon_];
  const std::span<const std::int32_t> vertices = topology_.polygons.polygon(polygon_);
  const auto n = static_cast<std::int32_t>(vertices.size());
  diagonals_.clear();
  for (const Triangle& t : triangles) {
    cell_.clear();
    for (int k = 0; k < 3; ++k) {
      const std::int32_t from = t[k];
      const std::int32_t to = t[(k + 1) % 3];
      if (to == (from + 1) % n) {
        append_edge(first + from, cell_);
      } else {
        append_diagonal(vertices[from], vertices[to]);
      }
    }
    if (cell_.is_undivided()) {
      add_patch({cell_.boundary[0], cell_.boundary[1], cell_.boundary[2], -1});
    } else {
      build_triangle_grid();
    }
  }
}

/// The polygon as triangles of its corners.
std::vector<Triangle> PatchBuilder::triangulate_corners(Index polygon,
                                                        const PolygonCell& cell) const {
  const std::vector<Vec3> corners = corner_positions(cell);
  const PlaneFrame frame(corners);
  std::vector<Vec2> flat;
  for (const Vec3& p : corners) flat.push_back(frame.to_plane(p));
  std::optional<std::vector<Triangle>> ears = clip_ears(flat);
  if (!ears) {
    throw radiosity::MeshError(source_prefix(scene_) + polygon_name(scene_, polygon) +
                               ": its outline of " + std::to_string(corners.size()) +
                               " corners, seen along its normal, crosses itself; expected a "
                               "simple polygon; split it into parts that do not cross");
  }
  if (ears->size() > 1) ears = make_delaunay(flat, *ears);
  return *std::move(ears);
}

void PatchBuilder::add_patch(const std::array<std::int32_t, 4>& c) {
  const std::int32_t surface = scene_.polygon_surface[polygon_];
  const auto polygon = static_cast<std::int32_t>(polygon_);
  if (!scene_.surfaces[surface].two_sided) {
    mesh_.add_patch(c, surface, polygon);
    return;
  }
  const auto front = static_cast<std::int32_t>(mesh_.size());
  const std::array<std::int32_t, 4> back =
      c[3] < 0 ? std::array<std::int32_t, 4>{c[2], c[1], c[0], -1}
               : std::array<std::int32_t, 4>{c[3], c[2], c[1], c[0]};
  mesh_.add_patch(c, surface, polygon, front + 1);
  mesh_.add_patch(back, surface, polygon, front);
  // Equal to the last bit, which summing in reverse order is not.
  mesh_.area.back() = mesh_.area[front];
  mesh_.normal.back() = -mesh_.normal[front];
  mesh_.centroid.back() = mesh_.centroid[front];
}

}  // namespace

radiosity::PatchMesh build_patches(const radiosity::Scene& scene, const Topology& topology,
                                   const EdgeDivision& division,
                                   const radiosity::Progress& progress) {
  return PatchBuilder(scene, topology, division, progress).run();
}

}  // namespace meshing
