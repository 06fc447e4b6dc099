#include <algorithm>
#include <optional>
#include <utility>

#include "meshing/base/text.h"
#include "meshing/inspect/findings.h"
#include "radiosity/base/box_tree.h"
#include "radiosity/base/disjoint_sets.h"

namespace meshing {
namespace {

using radiosity::Box3;
using radiosity::BoxTree;
using radiosity::Index;
using radiosity::Vec3;
using Severity = Finding::Severity;

/// A light this close to what it shines on, relative to the diagonal of the scene, is a mistake.
constexpr double kTooClose = 1e-3;
/// Closer than this two polygons touch.
constexpr double kTouching = 1e-6;

/// Distance along a ray (direction of any length; in units of it) to a flat polygon, if it hits.
std::optional<double> hit(const std::vector<Vec3>& polygon, const Vec3& origin,
                          const Vec3& direction) {
  const Vec3 normal = radiosity::vector_area(polygon);
  const double slope = direction.dot(normal);
  if (slope == 0) return std::nullopt;
  const double distance = (polygon[0] - origin).dot(normal) / slope;
  const Vec3 p = origin + distance * direction;

  // Even-odd rule in the coordinate plane that sees most of the polygon.
  int axis = 0;
  normal.cwiseAbs().maxCoeff(&axis);
  const int x = (axis + 1) % 3;
  const int y = (axis + 2) % 3;
  bool inside = false;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec3& a = polygon[k];
    const Vec3& b = polygon[(k + 1) % polygon.size()];
    if ((a[y] > p[y]) == (b[y] > p[y])) continue;
    if (p[x] < a[x] + (p[y] - a[y]) / (b[y] - a[y]) * (b[x] - a[x])) inside = !inside;
  }
  return inside ? std::optional(distance) : std::nullopt;
}

/// Polygons joined across edges.
struct Component {
  std::vector<Index> polygons;
  Box3 box;
  bool is_solid = false;     ///< every edge shared by two polygons that run along it opposite ways
  double signed_volume = 0;  ///< m³, > 0 if normals point outwards; of solid ones only
};

class OrientationFinder {
 public:
  explicit OrientationFinder(const ExaminedScene& examined)
      : examined_(examined),
        tree_(polygon_boxes()),
        component_of_(examined.polygons.size(), -1),
        findings_(examined.scene) {}

  std::vector<Finding> run() {
    find_disagreeing_neighbours();
    find_components();
    for (const Component& c : components_) {
      if (c.is_solid) judge(c);
    }
    find_lights_facing_walls();
    return findings_.take();
  }

 private:
  [[nodiscard]] std::vector<Box3> polygon_boxes() const;
  void find_disagreeing_neighbours();
  void find_components();
  void measure(Component& component) const;
  [[nodiscard]] bool contains(const Component& solid, const Vec3& point) const;
  [[nodiscard]] bool contains(const Component& solid, const Component& other) const;
  [[nodiscard]] bool is_inside_another(const Component& solid) const;
  [[nodiscard]] bool has_contents(const Component& solid) const;
  [[nodiscard]] bool looks_like_room(const Component& solid) const;
  void judge(const Component& solid);
  void find_lights_facing_walls();

  void add(Severity severity, Index polygon, const std::string& what) {
    findings_.add(Finding::Kind::flipped_orientation, severity, polygon, what);
  }

  const ExaminedScene& examined_;
  BoxTree tree_;                            // of polygons
  std::vector<std::int32_t> component_of_;  // per polygon; -1 if it is not usable
  FindingList findings_;
  std::vector<Component> components_;
  BoxTree component_tree_{{}};
};

std::vector<Box3> OrientationFinder::polygon_boxes() const {
  std::vector<Box3> boxes(examined_.polygons.size());
  for (Index i = 0; i < examined_.polygons.size(); ++i) {
    for (const Vec3& p : examined_.points(i)) boxes[i].extend(p);
    if (boxes[i].isEmpty()) boxes[i].extend(examined_.bounds.min());  // no corners left
  }
  return boxes;
}

void OrientationFinder::find_disagreeing_neighbours() {
  const EdgeTable& edges = examined_.edges;
  for (Index e = 0; e < edges.size(); ++e) {
    const std::span<const std::int64_t> uses = edges.uses_of(e);
    if (uses.size() != 2) continue;
    const std::int32_t a = edges.polygon_of_corner[uses[0]];
    const std::int32_t b = edges.polygon_of_corner[uses[1]];
    if (a == b || examined_.surface(a) != examined_.surface(b) || examined_.is_two_sided(a)) {
      continue;
    }
    if (examined_.is_forward(uses[0]) != examined_.is_forward(uses[1])) continue;
    add(Severity::warning, b,
        "it faces the other way than its neighbour, polygon " + std::to_string(a) +
            "; reverse the corners of one of them");
  }
}

void OrientationFinder::find_components() {
  const EdgeTable& edges = examined_.edges;
  const auto n = static_cast<Index>(examined_.polygons.size());
  radiosity::DisjointSets joined(n);
  for (Index e = 0; e < edges.size(); ++e) {
    const std::span<const std::int64_t> uses = edges.uses_of(e);
    for (const std::int64_t use : uses) {
      joined.join(edges.polygon_of_corner[uses[0]], edges.polygon_of_corner[use]);
    }
  }
  std::vector<std::int32_t> component_of_set(n, -1);
  for (Index i = 0; i < n; ++i) {
    if (!examined_.is_usable(i)) continue;
    std::int32_t& component = component_of_set[joined.find(i)];
    if (component < 0) {
      component = static_cast<std::int32_t>(components_.size());
      components_.emplace_back();
    }
    components_[component].polygons.push_back(i);
    component_of_[i] = component;
  }
  std::vector<Box3> boxes;
  for (Component& c : components_) {
    measure(c);
    boxes.push_back(c.box);
  }
  component_tree_ = BoxTree(std::move(boxes));
}

void OrientationFinder::measure(Component& component) const {
  for (const Index i : component.polygons) {
    for (const Vec3& p : examined_.points(i)) component.box.extend(p);
  }
  component.is_solid = true;
  const Vec3 center = component.box.center();
  for (const Index i : component.polygons) {
    const std::int64_t first = examined_.polygons.first_corner[i];
    const std::int64_t last = examined_.polygons.first_corner[i + 1];
    for (std::int64_t c = first; c < last; ++c) {
      const auto uses = examined_.edges.uses_of(examined_.edges.edge_of_corner[c]);
      if (uses.size() != 2 || examined_.is_forward(uses[0]) == examined_.is_forward(uses[1])) {
        component.is_solid = false;
      }
    }
    if (examined_.is_two_sided(i)) component.is_solid = false;
    const std::vector<Vec3> points = examined_.points(i);
    for (std::size_t k = 2; k < points.size(); ++k) {
      component.signed_volume +=
          (points[0] - center).dot((points[k - 1] - center).cross(points[k] - center)) / 6;
    }
  }
}

/// Even-odd rule along a ray that leaves the solid.
bool OrientationFinder::contains(const Component& solid, const Vec3& point) const {
  if (!solid.box.contains(point)) return false;
  // Almost along an axis, so that few boxes meet it, but parallel to nothing that is drawn.
  const Vec3 leave = 2 * solid.box.diagonal().norm() * Vec3(1, 5.377e-4, 2.931e-4);
  Box3 path(point);
  path.extend(Vec3(point + leave));
  const std::int32_t wanted = component_of_[solid.polygons.front()];
  bool inside = false;
  tree_.for_each_meeting(path, [&](std::int32_t i) {
    if (component_of_[i] != wanted) return;
    const std::optional<double> t = hit(examined_.points(i), point, leave);
    if (t && *t > 0) inside = !inside;
  });
  return inside;
}

bool OrientationFinder::contains(const Component& solid, const Component& other) const {
  constexpr std::size_t kSamples = 5;  // of its polygons; some may touch the solid
  if (!solid.box.intersects(other.box)) return false;
  std::size_t n_inside = 0;
  const std::size_t n = std::min(kSamples, other.polygons.size());
  for (std::size_t k = 0; k < n; ++k) {
    const Index i = other.polygons[k * other.polygons.size() / n];
    if (contains(solid, examined_.center(i))) ++n_inside;
  }
  return 2 * n_inside > n;
}

/// True if some but not all of the polygons emit: a room with a lamp among its walls.
bool OrientationFinder::looks_like_room(const Component& solid) const {
  const auto emits = [&](Index i) { return examined_.emits(i); };
  return components_.size() == 1 && !examined_.scene.camera &&
         std::any_of(solid.polygons.begin(), solid.polygons.end(), emits) &&
         !std::all_of(solid.polygons.begin(), solid.polygons.end(), emits);
}

bool OrientationFinder::is_inside_another(const Component& solid) const {
  bool found = false;
  component_tree_.for_each_meeting(solid.box, [&](std::int32_t c) {
    const Component& other = components_[c];
    found = found || (&other != &solid && other.is_solid && contains(other, solid));
  });
  return found;
}

bool OrientationFinder::has_contents(const Component& solid) const {
  const std::optional<radiosity::Camera>& camera = examined_.scene.camera;
  bool found = camera && contains(solid, camera->position);
  component_tree_.for_each_meeting(solid.box, [&](std::int32_t c) {
    const Component& other = components_[c];
    found = found || (&other != &solid && contains(solid, other));
  });
  return found;
}

/// Rooms should face inwards, things in rooms outwards. What is in a room and has something inside
/// itself may be either.
void OrientationFinder::judge(const Component& solid) {
  const std::string n = std::to_string(solid.polygons.size());
  const Index first = solid.polygons.front();
  const bool is_inside = is_inside_another(solid);
  const bool is_full = has_contents(solid);
  if (!is_inside && (is_full || looks_like_room(solid)) && solid.signed_volume > 0) {
    add(Severity::serious, first,
        "it belongs to a closed room of " + n +
            " polygons whose normals point outwards, away from what is inside; reverse their "
            "corners");
  } else if (is_inside && !is_full && solid.signed_volume < 0) {
    add(Severity::warning, first,
        "it belongs to a closed body of " + n +
            " polygons whose normals point inwards, so nothing outside sees it; reverse their "
            "corners");
  }
}

void OrientationFinder::find_lights_facing_walls() {
  std::vector<Index> lights;
  for (Index i = 0; i < examined_.polygons.size(); ++i) {
    if (examined_.is_usable(i) && examined_.emits(i) && !examined_.is_two_sided(i)) {
      lights.push_back(i);
    }
  }
  for (const Index light : lights) {
    const Vec3 origin = examined_.center(light);
    const Vec3 reach = kTooClose * examined_.size * examined_.normal(light);
    Box3 path(origin);
    path.extend(Vec3(origin + reach));
    Index nearest = -1;
    double least = 1;
    tree_.for_each_meeting(path, [&](std::int32_t i) {
      if (i == light || !examined_.is_usable(i)) return;
      const std::optional<double> t = hit(examined_.points(i), origin, reach);
      if (t && *t * kTooClose > kTouching && *t < least) {
        least = *t;
        nearest = i;
      }
    });
    if (nearest < 0) continue;
    add(Severity::warning, light,
        "this light shines straight at " + polygon_name(examined_.scene, nearest) + ", only " +
            number(least * reach.norm()) +
            " m away; if it should shine the other way reverse "
            "its corners");
  }
}

}  // namespace

std::vector<Finding> find_flipped_orientation(const ExaminedScene& examined) {
  return OrientationFinder(examined).run();
}

}  // namespace meshing
