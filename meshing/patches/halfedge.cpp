#include "meshing/patches/halfedge.h"

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>

#include "meshing/patches/largest_first.h"

namespace meshing {
namespace {

struct Traits : OpenMesh::DefaultTraitsDouble {
  VertexAttributes(0);
  FaceAttributes(0);
  EdgeAttributes(0);
  HalfedgeAttributes(OpenMesh::Attributes::PrevHalfedge);
};
using Mesh = OpenMesh::TriMesh_ArrayKernelT<Traits>;
using OpenMesh::EdgeHandle;
using OpenMesh::FaceHandle;
using OpenMesh::HalfedgeHandle;
using OpenMesh::VertexHandle;

/// Triangles whose circumradius is larger than this many times their shortest edge (an angle below
/// 28 degrees) are refined. Above 1 refinement ends, since no new edge is shorter than old ones.
constexpr double kRadiusToEdge = 1.065;
constexpr int kSmoothingRounds = 4;
constexpr double kNone = -2;  // below all that worst_angle_around finds
/// Far more than the rounding of angles.
constexpr double kAlike = 1e-9;

/// Constrained Delaunay triangulation that grows by points.
class Delaunay {
 public:
  explicit Delaunay(std::span<const Vec2> points) {
    for (const Vec2& p : points) add_point(p);
  }

  void add_triangle(std::int32_t a, std::int32_t b, std::int32_t c) {
    const FaceHandle face = mesh_.add_face(VertexHandle(a), VertexHandle(b), VertexHandle(c));
    assert(face.is_valid());
    static_cast<void>(face);
  }

  /// Puts existing point m on the boundary edge from a to b, next to a.
  void divide_boundary(std::int32_t a, std::int32_t b, std::int32_t m) {
    const HalfedgeHandle h = mesh_.find_halfedge(VertexHandle(a), VertexHandle(b));
    assert(h.is_valid() && mesh_.is_boundary(mesh_.edge_handle(h)));
    mesh_.split(mesh_.edge_handle(h), VertexHandle(m));
  }

  void flip_all() {
    for (const EdgeHandle e : mesh_.edges()) stack_.push_back(e);
    flip_stacked();
  }

  void refine(double max_edge, const radiosity::Progress& progress);
  void smooth(double max_edge, const radiosity::Progress& progress);

  [[nodiscard]] PlanarMesh result() const {
    PlanarMesh out;
    out.points = points_;
    out.triangles.reserve(mesh_.n_faces());
    for (const FaceHandle f : mesh_.faces()) {
      const std::array<VertexHandle, 3> c = corners(f);
      out.triangles.push_back({c[0].idx(), c[1].idx(), c[2].idx()});
    }
    return out;
  }

 private:
  void tell(const radiosity::Progress& progress) const {
    progress.check();
    const double done = (1 + smoothed_) * double(mesh_.n_faces());
    if (progress.report) progress.report("filling", done, 0, "triangles");
  }
  VertexHandle add_point(const Vec2& p) {
    points_.push_back(p);
    return mesh_.new_vertex();
  }
  [[nodiscard]] const Vec2& point(VertexHandle v) const { return points_[v.idx()]; }
  [[nodiscard]] std::array<VertexHandle, 3> corners(FaceHandle f) const {
    const HalfedgeHandle h = mesh_.halfedge_handle(f);
    return {mesh_.from_vertex_handle(h), mesh_.to_vertex_handle(h),
            mesh_.to_vertex_handle(mesh_.next_halfedge_handle(h))};
  }
  [[nodiscard]] double length(EdgeHandle e) const {
    const HalfedgeHandle h = mesh_.halfedge_handle(e, 0);
    return (point(mesh_.to_vertex_handle(h)) - point(mesh_.from_vertex_handle(h))).norm();
  }
  [[nodiscard]] VertexHandle apex(HalfedgeHandle h) const {
    return mesh_.to_vertex_handle(mesh_.next_halfedge_handle(h));
  }

  struct Circle {
    std::array<VertexHandle, 3> corners;  // of the face when this was found
    Vec2 center;
    double radius = 0;
    double shortest_edge = 0;
    double longest_edge = 0;
    int longest = 0;  // of the face's edges
  };
  [[nodiscard]] const Circle& circle(FaceHandle f);
  [[nodiscard]] Circle find_circle(const std::array<VertexHandle, 3>& corners) const;
  [[nodiscard]] EdgeHandle edge(FaceHandle f, int k) const;
  [[nodiscard]] bool is_too_long(FaceHandle f, const Circle& c, double max_edge) const {
    return c.longest_edge > max_edge && !mesh_.is_boundary(edge(f, c.longest));
  }
  [[nodiscard]] bool is_bad(FaceHandle f, const Circle& c, double max_edge) const {
    return c.radius > kRadiusToEdge * c.shortest_edge || is_too_long(f, c, max_edge);
  }

  [[nodiscard]] bool should_flip(EdgeHandle e) const;
  void flip_stacked();
  void push_edges_around(VertexHandle v);
  [[nodiscard]] std::optional<FaceHandle> locate(const Vec2& p, FaceHandle start) const;
  [[nodiscard]] bool encroaches(const Vec2& p, FaceHandle start);
  bool insert_center(FaceHandle f, const Circle& c);
  void insert_midpoint(EdgeHandle e);
  void push_if_bad(FaceHandle f, double max_edge);
  [[nodiscard]] double worst_angle_around(VertexHandle v, const Vec2& position, double max_edge,
                                          double least = kNone) const;

  Mesh mesh_;
  std::vector<Vec2> points_;  // of the vertices: closer together than the mesh has them
  std::vector<EdgeHandle> stack_;
  std::vector<VertexHandle> touched_;
  std::vector<FaceHandle> cavity_;
  std::vector<FaceHandle> changed_;
  std::vector<Circle> circles_;  // of faces, where they are known
  double smoothed_ = 0;          // share of the rounds
  LargestFirst bad_;             // faces by their circles' radii
};

double cotangent(const Vec2& apex, const Vec2& a, const Vec2& b) {
  return (a - apex).dot(b - apex) / signed_area2(apex, a, b);
}

/// The circumcircle of a face, found once for its corners in that order.
const Delaunay::Circle& Delaunay::circle(FaceHandle f) {
  const auto k = static_cast<std::size_t>(f.idx());
  if (k >= circles_.size()) circles_.resize(std::max(k + 1, 2 * circles_.size()));
  const std::array<VertexHandle, 3> its = corners(f);
  if (circles_[k].corners != its) circles_[k] = find_circle(its);
  return circles_[k];
}

Delaunay::Circle Delaunay::find_circle(const std::array<VertexHandle, 3>& corners) const {
  Circle c;
  c.corners = corners;
  c.shortest_edge = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k) {
    const double l = (point(corners[(k + 1) % 3]) - point(corners[k])).norm();
    c.shortest_edge = std::min(c.shortest_edge, l);
    if (l > c.longest_edge) {
      c.longest_edge = l;
      c.longest = k;
    }
  }
  const Vec2 a = point(corners[0]);
  const Vec2 ab = point(corners[1]) - a;
  const Vec2 ac = point(corners[2]) - a;
  const double d = 2 * (ab.x() * ac.y() - ab.y() * ac.x());
  const Vec2 offset(ac.y() * ab.squaredNorm() - ab.y() * ac.squaredNorm(),
                    ab.x() * ac.squaredNorm() - ac.x() * ab.squaredNorm());
  c.center = a + offset / d;
  c.radius = offset.norm() / std::abs(d);
  return c;
}

/// The edge of a face from corner k on.
EdgeHandle Delaunay::edge(FaceHandle f, int k) const {
  HalfedgeHandle h = mesh_.halfedge_handle(f);
  for (; k > 0; --k) h = mesh_.next_halfedge_handle(h);
  return mesh_.edge_handle(h);
}

/// True if the angles opposite to e add up to more than π (the other apex lies in the circumcircle)
/// by more than rounding, and flipping gives two proper triangles.
bool Delaunay::should_flip(EdgeHandle e) const {
  constexpr double kCocircular = 1e-9;
  if (mesh_.is_boundary(e)) return false;
  const HalfedgeHandle h = mesh_.halfedge_handle(e, 0);
  const HalfedgeHandle o = mesh_.halfedge_handle(e, 1);
  const Vec2 a = point(mesh_.from_vertex_handle(h));
  const Vec2 b = point(mesh_.to_vertex_handle(h));
  const Vec2 c = point(apex(h));
  const Vec2 d = point(apex(o));
  if (cotangent(c, a, b) + cotangent(d, b, a) >= -kCocircular) return false;
  const double sliver = 1e-14 * (c - d).squaredNorm();
  return signed_area2(c, a, d) > sliver && signed_area2(d, b, c) > sliver && mesh_.is_flip_ok(e);
}

void Delaunay::flip_stacked() {
  while (!stack_.empty()) {
    const EdgeHandle e = stack_.back();
    stack_.pop_back();
    if (!should_flip(e)) continue;
    mesh_.flip(e);
    for (const int side : {0, 1}) {
      const HalfedgeHandle h = mesh_.halfedge_handle(e, static_cast<unsigned>(side));
      touched_.push_back(mesh_.to_vertex_handle(h));
      stack_.push_back(mesh_.edge_handle(mesh_.next_halfedge_handle(h)));
      stack_.push_back(mesh_.edge_handle(mesh_.prev_halfedge_handle(h)));
    }
  }
}

void Delaunay::push_edges_around(VertexHandle v) {
  for (const HalfedgeHandle h : mesh_.voh_range(v)) {
    if (!mesh_.is_boundary(h)) stack_.push_back(mesh_.edge_handle(mesh_.next_halfedge_handle(h)));
    stack_.push_back(mesh_.edge_handle(h));
  }
}

/// The face that contains p, walking straight there; nothing if the boundary is in the way.
std::optional<FaceHandle> Delaunay::locate(const Vec2& p, FaceHandle start) const {
  FaceHandle face = start;
  // A walk in a Delaunay triangulation has no cycles; the limit guards against rounding.
  for (std::size_t step = 0; step < mesh_.n_faces() + 3; ++step) {
    HalfedgeHandle out;
    for (const HalfedgeHandle h : mesh_.fh_range(face)) {
      const Vec2 a = point(mesh_.from_vertex_handle(h));
      const Vec2 b = point(mesh_.to_vertex_handle(h));
      if (signed_area2(a, b, p) < 0) {
        out = h;
        break;
      }
    }
    if (!out.is_valid()) return face;
    face = mesh_.opposite_face_handle(out);
    if (!face.is_valid()) return std::nullopt;
  }
  return std::nullopt;
}

/// True if p lies in the circle on a boundary edge as diameter, looking at the triangles whose
/// circumcircle contains p.
bool Delaunay::encroaches(const Vec2& p, FaceHandle start) {
  std::vector<FaceHandle>& cavity = cavity_;
  cavity.assign(1, start);
  for (std::size_t k = 0; k < cavity.size(); ++k) {
    for (const HalfedgeHandle h : mesh_.fh_range(cavity[k])) {
      const FaceHandle next = mesh_.opposite_face_handle(h);
      if (!next.is_valid()) {
        const Vec2 a = point(mesh_.from_vertex_handle(h)) - p;
        const Vec2 b = point(mesh_.to_vertex_handle(h)) - p;
        if (a.dot(b) <= 0) return true;
        continue;
      }
      if (std::find(cavity.begin(), cavity.end(), next) != cavity.end()) continue;
      const Circle& c = circle(next);
      if ((p - c.center).norm() < c.radius) cavity.push_back(next);
    }
  }
  return false;
}

bool Delaunay::insert_center(FaceHandle f, const Circle& c) {
  const std::optional<FaceHandle> where = locate(c.center, f);
  if (!where || encroaches(c.center, *where)) return false;
  for (const HalfedgeHandle h : mesh_.fh_range(*where)) {
    const Vec2 a = point(mesh_.from_vertex_handle(h));
    const Vec2 b = point(mesh_.to_vertex_handle(h));
    if (signed_area2(a, b, c.center) > 1e-6 * (b - a).squaredNorm()) continue;
    if (mesh_.is_boundary(mesh_.edge_handle(h))) return false;
    // On an edge as good as exactly: splitting the face would leave a sliver there.
    const double t = (c.center - a).dot(b - a) / (b - a).squaredNorm();
    const VertexHandle v = add_point(a + t * (b - a));
    mesh_.split(mesh_.edge_handle(h), v);
    touched_.push_back(v);
    push_edges_around(v);
    flip_stacked();
    return true;
  }
  const VertexHandle v = add_point(c.center);
  mesh_.split(*where, v);
  touched_.push_back(v);
  push_edges_around(v);
  flip_stacked();
  return true;
}

void Delaunay::insert_midpoint(EdgeHandle e) {
  const HalfedgeHandle h = mesh_.halfedge_handle(e, 0);
  const Vec2 middle = (point(mesh_.from_vertex_handle(h)) + point(mesh_.to_vertex_handle(h))) / 2;
  const VertexHandle v = add_point(middle);
  mesh_.split(e, v);
  touched_.push_back(v);
  push_edges_around(v);
  flip_stacked();
}

void Delaunay::push_if_bad(FaceHandle f, double max_edge) {
  const Circle& c = circle(f);
  if (is_bad(f, c, max_edge)) bad_.push({c.radius, f.idx()});
}

void Delaunay::refine(double max_edge, const radiosity::Progress& progress) {
  for (const FaceHandle f : mesh_.faces()) push_if_bad(f, max_edge);
  for (long step = 0; !bad_.is_empty(); ++step) {
    if (step % 4096 == 0) tell(progress);
    const LargestFirst::Item bad = bad_.pop();
    const FaceHandle face(bad.index);
    const Circle c = circle(face);
    // Another face by now, which has an entry of its own if it is bad.
    if (c.radius != bad.size || !is_bad(face, c, max_edge)) continue;
    touched_.clear();
    if (!insert_center(face, c)) {
      if (!is_too_long(face, c, max_edge)) continue;
      insert_midpoint(edge(face, c.longest));
    }
    std::sort(touched_.begin(), touched_.end());
    touched_.erase(std::unique(touched_.begin(), touched_.end()), touched_.end());
    changed_.clear();
    for (const VertexHandle t : touched_) {
      for (const FaceHandle f : mesh_.vf_range(t)) changed_.push_back(f);
    }
    std::sort(changed_.begin(), changed_.end());
    changed_.erase(std::unique(changed_.begin(), changed_.end()), changed_.end());
    for (const FaceHandle f : changed_) push_if_bad(f, max_edge);
  }
}

/// Smallest angle of the triangles about v if v were at `position`; negative if one would be turned
/// over or an edge longer than max_edge. Anything up to `least` if it is no larger than that.
double Delaunay::worst_angle_around(VertexHandle v, const Vec2& position, double max_edge,
                                    double least) const {
  double worst = radiosity::kPi;
  double largest = -std::numeric_limits<double>::infinity();  // cotangent
  for (const HalfedgeHandle h : mesh_.voh_range(v)) {
    const Vec2 a = point(mesh_.to_vertex_handle(h)) - position;
    const Vec2 b = point(apex(h)) - position;
    const double area2 = a.x() * b.y() - a.y() * b.x();
    if (area2 <= 0 || a.norm() > max_edge) return -1;
    const std::array<double, 3> dots = {a.dot(b), -a.dot(b - a), b.dot(b - a)};
    // Only of angles that are the smallest so far, or may be by rounding.
    largest = std::max(largest, *std::max_element(dots.begin(), dots.end()) / area2);
    const double alike = area2 * (largest - kAlike * (1 + std::abs(largest)));
    for (const double dot : dots) {
      if (!(dot < alike)) worst = std::min(worst, std::atan2(area2, dot));
    }
    if (worst <= least) return worst;
  }
  return worst;
}

/// Moves points inside to the mean of their neighbours where that improves the worst angle.
void Delaunay::smooth(double max_edge, const radiosity::Progress& progress) {
  for (int round = 0; round < kSmoothingRounds; ++round) {
    for (const VertexHandle v : mesh_.vertices()) {
      if (mesh_.is_boundary(v)) continue;
      Vec2 mean = Vec2::Zero();
      for (const VertexHandle w : mesh_.vv_range(v)) mean += point(w);
      mean /= mesh_.valence(v);
      const double worst = worst_angle_around(v, point(v), max_edge);
      if (worst_angle_around(v, mean, max_edge, worst) > worst) points_[v.idx()] = mean;
    }
    flip_all();
    smoothed_ += 1.0 / kSmoothingRounds;
    tell(progress);
  }
  circles_.clear();
}

}  // namespace

std::vector<Triangle> make_delaunay(std::span<const Vec2> points,
                                    std::span<const Triangle> triangles) {
  Delaunay delaunay(points);
  for (const Triangle& t : triangles) delaunay.add_triangle(t[0], t[1], t[2]);
  delaunay.flip_all();
  return delaunay.result().triangles;
}

PlanarMesh refine(const DividedPolygon& polygon, double max_edge,
                  const radiosity::Progress& progress) {
  Delaunay delaunay(polygon.boundary);
  const std::vector<std::int32_t>& corners = polygon.corners;
  for (const Triangle& t : polygon.triangles) {
    delaunay.add_triangle(corners[t[0]], corners[t[1]], corners[t[2]]);
  }
  const auto n_boundary = static_cast<std::int32_t>(polygon.boundary.size());
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const std::int32_t end = corners[(k + 1) % corners.size()];
    const std::int32_t last = k + 1 < corners.size() ? end : n_boundary;
    for (std::int32_t m = corners[k] + 1; m < last; ++m) delaunay.divide_boundary(m - 1, end, m);
  }
  delaunay.flip_all();
  delaunay.refine(max_edge, progress);
  delaunay.smooth(max_edge, progress);
  delaunay.refine(max_edge, progress);
  return delaunay.result();
}

}  // namespace meshing
