#include "viewer/desk/coarse_mesh.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <tuple>
#include <unordered_map>
#include <utility>

namespace viewer {
namespace {

using radiosity::Index;
using radiosity::PatchMesh;
using radiosity::Vec3;

constexpr Index kFewPatches = 16;  // to a polygon, below which polygons are taken together
constexpr double kFacing = 2;      // steps of a normal's components that count as facing alike
constexpr double kStraight = 0.1;  // radian that an edge may turn at a vertex

std::uint64_t mixed(std::uint64_t hash, std::uint64_t value) {
  // (Vigna 2015, splitmix64)
  hash += value + 0x9e3779b97f4a7c15U;
  hash = (hash ^ (hash >> 30U)) * 0xbf58476d1ce4e5b9U;
  hash = (hash ^ (hash >> 27U)) * 0x94d049bb133111ebU;
  return hash ^ (hash >> 31U);
}

std::uint64_t bits(double value) { return static_cast<std::uint64_t>(std::llround(value)); }

/// A number for the face that each patch is part of.
std::vector<std::uint64_t> faces_of(const PatchMesh& mesh, bool by_polygon) {
  std::vector<std::uint64_t> faces(mesh.corners.size());
  for (Index i = 0; i < mesh.size(); ++i) {
    std::uint64_t face = mixed(0, static_cast<std::uint64_t>(mesh.surface[i]));
    // Of two-sided polygons both sides.
    const Vec3 step = by_polygon ? Vec3(mesh.normal[i]) : Vec3(kFacing * mesh.normal[i]);
    for (int k = 0; k < 3; ++k) face = mixed(face, bits(step[k]));
    if (by_polygon) face = mixed(face, static_cast<std::uint64_t>(mesh.polygon[i]));
    faces[i] = face;
  }
  return faces;
}

/// Per vertex: the first of those at the same place.
std::vector<std::int32_t> welded(const std::vector<Vec3>& vertices) {
  std::unordered_multimap<std::uint64_t, std::int32_t> seen;
  seen.reserve(vertices.size());
  std::vector<std::int32_t> first(vertices.size());
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    std::uint64_t hash = 0;
    for (int k = 0; k < 3; ++k) {
      hash = mixed(hash, std::hash<double>()(vertices[v][k] + 0.0));  // -0 is 0
    }
    first[v] = static_cast<std::int32_t>(v);
    const auto [begin, end] = seen.equal_range(hash);
    const auto same = std::find_if(
        begin, end, [&](const auto& other) { return vertices[other.second] == vertices[v]; });
    if (same == end) {
      seen.emplace(hash, first[v]);
    } else {
      first[v] = same->second;
    }
  }
  return first;
}

/// A face at a vertex, and the angle that it takes there.
struct Touch {
  std::int32_t vertex;
  std::uint64_t face;
  std::int64_t slot;
  double angle;
};

/// All faces at all vertices, vertex by vertex and face by face.
std::vector<Touch> find_touches(const PatchMesh& mesh, const std::vector<std::uint64_t>& faces) {
  const std::vector<std::int32_t> first = welded(mesh.vertices);
  std::vector<Touch> touches;
  touches.reserve(4 * mesh.corners.size());
  for (Index i = 0; i < mesh.size(); ++i) {
    for (int k = 0; k < mesh.n_corners(i); ++k) {
      touches.push_back({first[mesh.corners[i][k]], faces[i], 4 * i + k, corner_angle(mesh, i, k)});
    }
  }
  std::sort(touches.begin(), touches.end(), [](const Touch& a, const Touch& b) {
    return std::tie(a.vertex, a.face, a.slot) < std::tie(b.vertex, b.face, b.slot);
  });
  return touches;
}

/// Calls visit(begin, end) for each run of touches that `same` finds alike.
template <typename Same, typename Visit>
void for_runs(std::span<const Touch> touches, const Same& same, const Visit& visit) {
  for (std::size_t begin = 0; begin < touches.size();) {
    std::size_t end = begin + 1;
    while (end < touches.size() && same(touches[begin], touches[end])) ++end;
    visit(touches.subspan(begin, end - begin));
    begin = end;
  }
}

bool has_same_vertex(const Touch& a, const Touch& b) { return a.vertex == b.vertex; }
bool has_same_face(const Touch& a, const Touch& b) { return a.face == b.face; }

/// What vertices must have in common to be taken together: the faces there, and whether the vertex
/// lies on an edge that nothing else shares. Corners of faces (`keeps_corners`) share it with none.
std::uint64_t kind_of(std::span<const Touch> at_vertex, bool keeps_corners) {
  std::uint64_t kind = 0;
  bool is_corner = false;
  for_runs(at_vertex, has_same_face, [&](std::span<const Touch> of_face) {
    double angle = 0;
    for (const Touch& touch : of_face) angle += touch.angle;
    const bool is_inside = std::abs(angle - 2 * radiosity::kPi) < kStraight;
    is_corner |= !is_inside && std::abs(angle - radiosity::kPi) >= kStraight;
    kind = mixed(mixed(kind, of_face[0].face), is_inside ? 1 : 0);
  });
  if (is_corner && keeps_corners) {
    kind = mixed(kind, static_cast<std::uint64_t>(at_vertex[0].vertex));
  }
  return kind;
}

}  // namespace

CoarseMesh::CoarseMesh(const PatchMesh& mesh, Index n_wanted) {
  point_of_.assign(4 * mesh.corners.size(), -1);
  Index n_polygons = 1;
  for (const std::int32_t polygon : mesh.polygon)
    n_polygons = std::max<Index>(n_polygons, polygon + 1);
  const bool by_polygon = n_polygons * kFewPatches <= mesh.size();
  const std::vector<Touch> touches = find_touches(mesh, faces_of(mesh, by_polygon));
  const double area = std::accumulate(mesh.area.begin(), mesh.area.end(), 0.0);
  const double side = std::sqrt(area / static_cast<double>(std::max<Index>(n_wanted, 1)));
  // A little off, since vertices of grids would lie between cells.
  const Vec3 origin = radiosity::bounds(mesh).min() - side * Vec3(0.37, 0.41, 0.43);

  // Clusters of vertices, each at the place of the one that is nearest to its cell's centre.
  struct Cluster {
    Vec3 place;
    double distance;
  };
  std::vector<Cluster> clusters;
  std::unordered_map<std::uint64_t, std::int32_t> known;
  std::vector<std::pair<std::span<const Touch>, std::int32_t>> vertices;
  for_runs(touches, has_same_vertex, [&](std::span<const Touch> at_vertex) {
    const Vec3& place = mesh.vertices[at_vertex[0].vertex];
    const Vec3 cell = ((place - origin) / side).array().floor();
    std::uint64_t key = kind_of(at_vertex, by_polygon);
    for (int k = 0; k < 3; ++k) key = mixed(key, bits(cell[k]));
    const double distance =
        (place - origin - side * (cell + Vec3::Constant(0.5))).lpNorm<Eigen::Infinity>();
    const auto [found, is_new] = known.try_emplace(key, static_cast<std::int32_t>(clusters.size()));
    if (is_new) clusters.push_back({place, distance});
    Cluster& cluster = clusters[found->second];
    if (distance < cluster.distance) cluster = {place, distance};
    vertices.emplace_back(at_vertex, found->second);
  });

  std::unordered_map<std::uint64_t, std::int32_t> points;
  for (const auto& [at_vertex, its_cluster] : vertices) {
    const std::int32_t cluster = its_cluster;
    for_runs(at_vertex, has_same_face, [&](std::span<const Touch> of_face) {
      const auto [found, is_new] =
          points.try_emplace(mixed(of_face[0].face, static_cast<std::uint64_t>(cluster)),
                             static_cast<std::int32_t>(positions_.size()));
      if (is_new) positions_.push_back(clusters[cluster].place);
      for (const Touch& touch : of_face) point_of_[touch.slot] = found->second;
    });
  }
  add_triangles(mesh);
}

/// Of the patches whose corners are three or four points still.
void CoarseMesh::add_triangles(const PatchMesh& mesh) {
  for (Index i = 0; i < mesh.size(); ++i) {
    std::array<std::int32_t, 4> corners{};
    int n = 0;
    for (int k = 0; k < mesh.n_corners(i); ++k) {
      const std::int32_t point = point_of_[4 * i + k];
      if (std::find(corners.begin(), corners.begin() + n, point) == corners.begin() + n) {
        corners[n++] = point;
      }
    }
    for (int k = 2; k < n; ++k) {
      // Where a fold lies, others lie over it.
      const Vec3& origin = positions_[corners[0]];
      const Vec3 across =
          (positions_[corners[k - 1]] - origin).cross(positions_[corners[k]] - origin);
      if (across.dot(mesh.normal[i]) <= 0) continue;
      triangles_.push_back({corners[0], corners[k - 1], corners[k]});
      has_back_.push_back(mesh.twin[i] < 0 ? 1 : 0);
      surfaces_.push_back(mesh.surface[i]);
    }
  }
}

std::vector<io::Rgb> CoarseMesh::colors(std::span<const io::Rgb> corners) const {
  std::vector<std::array<std::uint32_t, 4>> sums(positions_.size());
  for (std::size_t slot = 0; slot < point_of_.size(); ++slot) {
    if (point_of_[slot] < 0) continue;
    auto& sum = sums[point_of_[slot]];
    for (int c = 0; c < 3; ++c) sum[c] += corners[slot][c];
    ++sum[3];
  }
  std::vector<io::Rgb> result(sums.size());
  for (std::size_t p = 0; p < sums.size(); ++p) {
    for (int c = 0; c < 3; ++c) {
      result[p][c] = static_cast<std::uint8_t>((sums[p][c] + sums[p][3] / 2) / sums[p][3]);
    }
  }
  return result;
}

std::vector<float> CoarseMesh::values(std::span<const float> corners) const {
  std::vector<double> sums(positions_.size());
  std::vector<std::int32_t> counts(positions_.size());
  for (std::size_t slot = 0; slot < point_of_.size(); ++slot) {
    if (point_of_[slot] < 0 || corners[slot] < 0) continue;
    sums[point_of_[slot]] += static_cast<double>(corners[slot]);
    ++counts[point_of_[slot]];
  }
  std::vector<float> result(sums.size(), -1.F);
  for (std::size_t p = 0; p < sums.size(); ++p) {
    if (counts[p] > 0) result[p] = static_cast<float>(sums[p] / counts[p]);
  }
  return result;
}

}  // namespace viewer
