#include "meshing/inspect/bad_polygons.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "meshing/base/edge_table.h"
#include "meshing/base/outline.h"
#include "meshing/base/polygon_shape.h"
#include "meshing/base/text.h"
#include "meshing/base/weld.h"

namespace meshing {
namespace {

using radiosity::Emission;
using radiosity::Index;
using radiosity::Scene;
using radiosity::Vec3;

/// What is done with an outline takes the square of its corners: 0.5 s for so many.
constexpr std::size_t kMostCorners = 10'000;

/// "2 polygons enclose no area and are left out: surface 'a', polygon 3, surface 'a', polygon 9".
class Fault {
 public:
  void add(Index polygon) { polygons_.push_back(polygon); }
  void report(const Scene& scene, const std::string& singular, const std::string& plural,
              std::vector<std::string>& repairs) const {
    const std::size_t n = polygons_.size();
    if (n == 0) return;
    const std::size_t n_named = std::min(n, kNamed);
    std::vector<Index> first(n_named);
    std::partial_sort_copy(polygons_.begin(), polygons_.end(), first.begin(), first.end());
    std::string text = source_prefix(scene) + std::to_string(n) + (n == 1 ? singular : plural);
    for (std::size_t k = 0; k < n_named; ++k) {
      text += (k == 0 ? ": " : "; ") + polygon_name(scene, first[k]);
    }
    if (n > n_named) text += "; and " + std::to_string(n - n_named) + " more";
    repairs.push_back(text);
  }

 private:
  static constexpr std::size_t kNamed = 3;
  std::vector<Index> polygons_;
};

/// Equal for polygons with the same corners, in whatever order.
std::uint64_t corner_hash(std::span<const std::int32_t> corners) {
  std::uint64_t sum = 0;
  for (const std::int32_t corner : corners) {
    std::uint64_t h = static_cast<std::uint32_t>(corner) + 1;
    h *= 0x9E3779B97F4A7C15U;
    h ^= h >> 29U;
    sum += h * 0xff51afd7ed558ccdU;
  }
  return sum;
}

class Cleaner {
 public:
  explicit Cleaner(Scene scene) : scene_(std::move(scene)), polygons_(weld(scene_)) {}

  CleanScene run() {
    is_bad_.assign(scene_.n_polygons(), false);
    std::vector<std::string> repairs;
    find_bad_shapes(repairs);
    find_duplicates(repairs);
    if (std::find(is_bad_.begin(), is_bad_.end(), true) != is_bad_.end()) {
      polygons_ = without_bad(polygons_);
    }
    find_non_manifold(repairs);
    remove_bad();
    return {std::move(scene_), std::move(repairs)};
  }

 private:
  void find_bad_shapes(std::vector<std::string>& repairs);
  void find_duplicates(std::vector<std::string>& repairs);
  void compare(std::span<const Index> same_hash, Fault& fault);
  void find_non_manifold(std::vector<std::string>& repairs) const;
  void remove_bad();

  /// Which of two equal polygons stays: the larger number.
  [[nodiscard]] int rank(Index i) const {
    const radiosity::Surface& surface = scene_.surfaces[scene_.polygon_surface[i]];
    const auto material = static_cast<std::size_t>(surface.material);
    const bool emits = material < scene_.materials.size() &&
                       scene_.materials[material].emission.kind != Emission::Kind::none;
    return (emits ? 2 : 0) + (is_two_sided(i) ? 1 : 0);
  }
  [[nodiscard]] bool is_two_sided(Index i) const {
    return scene_.surfaces[scene_.polygon_surface[i]].two_sided;
  }
  /// With no corners where they are bad, so that the others keep their numbers.
  [[nodiscard]] WeldedPolygons without_bad(const WeldedPolygons& all) const {
    WeldedPolygons kept;
    kept.vertices = all.vertices;
    for (Index i = 0; i < all.size(); ++i) {
      const auto corners = all.polygon(i);
      if (!is_bad_[i]) kept.corners.insert(kept.corners.end(), corners.begin(), corners.end());
      kept.first_corner.push_back(static_cast<std::int64_t>(kept.corners.size()));
    }
    return kept;
  }

  Scene scene_;
  WeldedPolygons polygons_;
  std::vector<bool> is_bad_;
};

void Cleaner::find_bad_shapes(std::vector<std::string>& repairs) {
  Fault too_long;
  Fault no_area;
  Fault crossing;
  Fault repeating;
  std::vector<Vec3> points;
  for (Index i = 0; i < scene_.n_polygons(); ++i) {
    points.clear();
    if (polygons_.polygon(i).size() > kMostCorners) {
      too_long.add(i);
      is_bad_[i] = true;
      continue;
    }
    for (const std::int32_t v : polygons_.polygon(i)) points.push_back(polygons_.vertices[v]);
    const PolygonKind kind = polygon_shape(points, scene_.precision).kind;
    if (kind == PolygonKind::zero_area) {
      no_area.add(i);
    } else if (has_crossing_outline(kind, points)) {
      crossing.add(i);
    } else {
      if (points.size() < scene_.polygon(i).size()) repeating.add(i);
      continue;
    }
    is_bad_[i] = true;
  }
  const std::string most = " more than " + std::to_string(kMostCorners) + " corners";
  too_long.report(scene_, " polygon has" + most + " and is left out",
                  " polygons have" + most + " and are left out", repairs);
  no_area.report(scene_, " polygon encloses no area and is left out",
                 " polygons enclose no area and are left out", repairs);
  crossing.report(scene_, " polygon has an outline that crosses or touches itself and is left out",
                  " polygons have outlines that cross or touch themselves and are left out",
                  repairs);
  repeating.report(scene_, " polygon repeats a corner, which counts once",
                   " polygons repeat a corner, which counts once", repairs);
}

void Cleaner::find_duplicates(std::vector<std::string>& repairs) {
  std::vector<std::pair<std::uint64_t, Index>> sorted;
  sorted.reserve(scene_.n_polygons());
  for (Index i = 0; i < scene_.n_polygons(); ++i) {
    if (!is_bad_[i]) sorted.emplace_back(corner_hash(polygons_.polygon(i)), i);
  }
  std::sort(sorted.begin(), sorted.end());
  Fault fault;
  std::vector<Index> same;
  for (std::size_t k = 0; k < sorted.size(); ++k) {
    if (k == 0 || sorted[k].first != sorted[k - 1].first) same.clear();
    same.push_back(sorted[k].second);
    const bool is_last = k + 1 == sorted.size() || sorted[k + 1].first != sorted[k].first;
    if (is_last && same.size() > 1) compare(same, fault);
  }
  fault.report(scene_, " polygon is the same as another one and is left out",
               " polygons are the same as others and are left out", repairs);
}

/// Leaves out all polygons but one of each outline and side.
void Cleaner::compare(std::span<const Index> same_hash, Fault& fault) {
  std::vector<std::pair<Outline, Index>> kept;
  std::vector<Index> by_rank(same_hash.begin(), same_hash.end());
  std::stable_sort(by_rank.begin(), by_rank.end(),
                   [&](Index a, Index b) { return rank(a) > rank(b); });
  for (const Index i : by_rank) {
    Outline shape = outline(polygons_.polygon(i));
    const bool is_known = std::any_of(kept.begin(), kept.end(), [&](const auto& other) {
      if (other.first.corners != shape.corners) return false;
      return other.first.reversed == shape.reversed || is_two_sided(i) ||
             is_two_sided(other.second);
    });
    if (is_known) {
      fault.add(i);
      is_bad_[i] = true;
    } else {
      kept.emplace_back(std::move(shape), i);
    }
  }
}

void Cleaner::find_non_manifold(std::vector<std::string>& repairs) const {
  const EdgeTable edges = make_edge_table(polygons_);
  long n_edges = 0;
  std::string first;
  for (Index e = 0; e < edges.size(); ++e) {
    const std::vector<std::int32_t> meeting = non_manifold_polygons(scene_, edges, e);
    if (meeting.empty() || n_edges++ > 0) continue;
    first = std::to_string(meeting.size()) + " at the edge from " +
            place(polygons_.vertices[edges.ends[e][0]]) + " to " +
            place(polygons_.vertices[edges.ends[e][1]]) + " of " + polygon_name(scene_, meeting[0]);
  }
  if (n_edges == 0) return;
  repairs.push_back(source_prefix(scene_) + "more than two polygons of one surface meet at " +
                    std::to_string(n_edges) + (n_edges == 1 ? " edge" : " edges") +
                    ", and are kept: " + first);
}

void Cleaner::remove_bad() {
  Index n = 0;
  std::size_t n_corners = 0;
  for (Index i = 0; i < static_cast<Index>(is_bad_.size()); ++i) {
    if (is_bad_[i]) continue;
    const std::int64_t first = scene_.first_corner[i];
    const std::int64_t last = scene_.first_corner[i + 1];
    std::copy(scene_.corners.begin() + first, scene_.corners.begin() + last,
              scene_.corners.begin() + static_cast<std::ptrdiff_t>(n_corners));
    if (!scene_.texture_coordinates.empty()) {
      std::copy(scene_.texture_coordinates.begin() + first,
                scene_.texture_coordinates.begin() + last,
                scene_.texture_coordinates.begin() + static_cast<std::ptrdiff_t>(n_corners));
    }
    n_corners += static_cast<std::size_t>(last - first);
    scene_.polygon_surface[n] = scene_.polygon_surface[i];
    scene_.first_corner[++n] = static_cast<std::int64_t>(n_corners);
  }
  scene_.corners.resize(n_corners);
  if (!scene_.texture_coordinates.empty()) scene_.texture_coordinates.resize(n_corners);
  scene_.polygon_surface.resize(n);
  scene_.first_corner.resize(n + 1);
}

}  // namespace

CleanScene leave_out_bad_polygons(Scene scene) { return Cleaner(std::move(scene)).run(); }

}  // namespace meshing
