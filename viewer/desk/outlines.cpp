#include "viewer/desk/outlines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <unordered_map>

namespace viewer {
namespace {

using radiosity::Index;
using radiosity::PatchMesh;
using radiosity::Vec3;

constexpr double kFlatAngle = 0.01;  // below, nothing turns away: radian
constexpr double kSamePlace = 1e-6;  // of the scene's size
constexpr int kMostHalvings = 20;

/// Vertices by their places: those of different surfaces at one place are one.
class Places {
 public:
  explicit Places(const PatchMesh& mesh)
      : cell_(kSamePlace * std::max(bounds(mesh).diagonal().norm(), 1e-300)) {
    for (const Vec3& vertex : mesh.vertices) {
      ids_.push_back(
          by_place_.emplace(key(vertex), static_cast<std::int32_t>(points_.size())).first->second);
      if (ids_.back() == static_cast<std::int32_t>(points_.size())) points_.push_back(vertex);
    }
  }

  [[nodiscard]] std::int32_t of_vertex(std::int32_t vertex) const { return ids_[vertex]; }
  [[nodiscard]] const Vec3& point(std::int32_t place) const { return points_[place]; }
  /// The place in the middle of two; negative if there is none.
  [[nodiscard]] std::int32_t between(std::int32_t a, std::int32_t b) const {
    const auto found = by_place_.find(key(0.5 * (points_[a] + points_[b])));
    return found == by_place_.end() ? -1 : found->second;
  }

 private:
  using Key = std::array<std::int64_t, 3>;
  struct Hash {
    std::size_t operator()(const Key& key) const {
      std::uint64_t hash = 0;
      for (const std::int64_t part : key) {
        hash = (hash ^ static_cast<std::uint64_t>(part)) * 0x9E3779B97F4A7C15U;
        hash ^= hash >> 29U;
      }
      return hash;
    }
  };
  [[nodiscard]] Key key(const Vec3& point) const {
    return {std::llround(point.x() / cell_), std::llround(point.y() / cell_),
            std::llround(point.z() / cell_)};
  }

  double cell_;
  std::unordered_map<Key, std::int32_t, Hash> by_place_;
  std::vector<std::int32_t> ids_;
  std::vector<Vec3> points_;
};

/// A patch at an edge between two places, the lesser first.
struct EdgeUse {
  std::int32_t first = 0;
  std::int32_t second = 0;
  Index patch = 0;

  [[nodiscard]] bool is_at(const EdgeUse& other) const {
    return first == other.first && second == other.second;
  }
};

void add_edge(std::vector<EdgeUse>& uses, const Places& places, EdgeUse use, int depth = 0) {
  const std::int32_t middle = places.between(use.first, use.second);
  if (middle < 0 || middle == use.first || middle == use.second || depth == kMostHalvings) {
    if (use.first > use.second) std::swap(use.first, use.second);
    if (use.first != use.second) uses.push_back(use);
    return;
  }
  add_edge(uses, places, {use.first, middle, use.patch}, depth + 1);
  add_edge(uses, places, {middle, use.second, use.patch}, depth + 1);
}

std::vector<EdgeUse> edge_uses(const PatchMesh& mesh, const Places& places,
                               const HiddenSurfaces& hidden) {
  std::vector<EdgeUse> uses;
  for (Index i = 0; i < mesh.size(); ++i) {
    const bool is_second_side = mesh.twin[i] >= 0 && mesh.twin[i] < i;
    if (is_second_side || hidden.contains(mesh.surface[i])) continue;
    const int n = mesh.n_corners(i);
    for (int k = 0; k < n; ++k) {
      add_edge(uses, places,
               {places.of_vertex(mesh.corners[i][k]),
                places.of_vertex(mesh.corners[i][(k + 1) % n]), i});
    }
  }
  std::sort(uses.begin(), uses.end(), [](const EdgeUse& a, const EdgeUse& b) {
    if (a.first != b.first) return a.first < b.first;
    if (a.second != b.second) return a.second < b.second;
    return a.patch < b.patch;
  });
  return uses;
}

/// Adds the edge that these patches have in common, if it is one to see.
void add_line(std::vector<SurfaceLine>& lines, const PatchMesh& mesh, const Places& places,
              std::span<const EdgeUse> uses) {
  const Index first = uses.front().patch;
  SurfaceLine line;
  line.ends = {places.point(uses.front().first), places.point(uses.front().second)};
  line.normals = {mesh.normal[first], mesh.normal[first]};
  line.color = kOutlineColor;
  double least_cosine = uses.size() == 1 ? -1 : 1;
  bool has_other_surface = false;
  for (const EdgeUse& use : uses.subspan(1)) {
    has_other_surface |= mesh.surface[use.patch] != mesh.surface[first];
    const double cosine = mesh.normal[first].dot(mesh.normal[use.patch]);
    if (cosine > least_cosine) continue;
    least_cosine = cosine;
    line.normals[1] = mesh.normal[use.patch];
  }
  line.is_sharp = has_other_surface || least_cosine < std::cos(kCreaseAngle);
  if (!line.is_sharp && least_cosine > std::cos(kFlatAngle)) return;
  const bool has_two_sides = std::any_of(
      uses.begin(), uses.end(), [&](const EdgeUse& use) { return mesh.twin[use.patch] >= 0; });
  if (has_two_sides && line.is_sharp) line.normals[1] = -line.normals[0];
  lines.push_back(line);
}

}  // namespace

std::vector<SurfaceLine> make_outlines(const PatchMesh& mesh, const HiddenSurfaces& hidden) {
  const Places places(mesh);
  const std::vector<EdgeUse> uses = edge_uses(mesh, places, hidden);
  std::vector<SurfaceLine> lines;
  for (std::size_t k = 0; k < uses.size();) {
    std::size_t end = k + 1;
    while (end < uses.size() && uses[end].is_at(uses[k])) ++end;
    add_line(lines, mesh, places, std::span(uses).subspan(k, end - k));
    k = end;
  }
  return lines;
}

}  // namespace viewer
