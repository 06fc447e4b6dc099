#include "radiosity/blocker.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>

#include "radiosity/disjoint_sets.h"

namespace radiosity {
namespace {

using EdgeKey = std::array<double, 6>;

EdgeKey key_of(const Vec3& start, const Vec3& end) {
  return {start.x(), start.y(), start.z(), end.x(), end.y(), end.z()};
}

const Vec3& corner_after(const Occluder& occluder, std::size_t k) {
  return occluder.corners[k + 1 < occluder.corners.size() ? k + 1 : 0];
}

Blocker polygon_blocker(const Occluder& occluder) {
  Blocker result;
  result.faces = {{occluder.normal, occluder.offset}, {-occluder.normal, -occluder.offset}};
  for (std::size_t k = 0; k < occluder.corners.size(); ++k) {
    result.edges.push_back({occluder.corners[k], corner_after(occluder, k), 0, 1});
  }
  result.corners = occluder.corners;
  result.box = occluder.box;
  return result;
}

/// Groups one-sided occluders that share edges and tries to make a body of each group.
class BodyFinder {
 public:
  BodyFinder(const std::vector<Occluder>& occluders, const PatchMesh& mesh, double thickness)
      : occluders_(occluders),
        mesh_(mesh),
        thickness_(thickness),
        groups_(static_cast<Index>(occluders.size())) {}

  std::vector<Blocker> find() {
    join_along_edges();
    std::vector<Blocker> result;
    for (const std::vector<Index>& group : groups_.sets()) {
      if (const std::optional<Blocker> body = make_body(group)) {
        result.push_back(*body);
      } else {
        for (const Index k : group) result.push_back(polygon_blocker(occluders_[k]));
      }
    }
    return result;
  }

 private:
  void join_along_edges() {
    for (Index k = 0; k < static_cast<Index>(occluders_.size()); ++k) {
      const Occluder& occluder = occluders_[k];
      if (!occluder.is_one_sided) continue;
      for (std::size_t c = 0; c < occluder.corners.size(); ++c) {
        owners_[key_of(occluder.corners[c], corner_after(occluder, c))].push_back(k);
      }
    }
    for (const auto& [key, owners] : owners_) {
      const auto opposite = owners_.find({key[3], key[4], key[5], key[0], key[1], key[2]});
      if (opposite != owners_.end()) groups_.join(owners.front(), opposite->second.front());
    }
  }

  /// The closed convex body that the group bounds, if it does.
  [[nodiscard]] std::optional<Blocker> make_body(const std::vector<Index>& group) const {
    if (group.size() < 3 || group.size() >= Blocker::kMostFaces) return std::nullopt;
    Blocker body;
    std::map<Index, int> face_of;
    Vec3 open_area = Vec3::Zero();
    for (const Index k : group) {
      const Occluder& occluder = occluders_[k];
      face_of[k] = static_cast<int>(body.faces.size());
      body.faces.push_back({occluder.normal, occluder.offset});
      open_area -= vector_area(occluder.corners);
      body.box.extend(occluder.box);
      body.corners.insert(body.corners.end(), occluder.corners.begin(), occluder.corners.end());
    }
    const auto cap = static_cast<int>(body.faces.size());
    std::vector<Vec3> rim;
    for (const Index k : group) {
      const Occluder& occluder = occluders_[k];
      for (std::size_t c = 0; c < occluder.corners.size(); ++c) {
        const Vec3& start = occluder.corners[c];
        const Vec3& end = corner_after(occluder, c);
        const auto opposite = owners_.find(key_of(end, start));
        const bool is_shared = opposite != owners_.end();
        if (owners_.at(key_of(start, end)).size() > 1) return std::nullopt;
        if (is_shared && opposite->second.size() > 1) return std::nullopt;
        if (!is_shared) rim.push_back(start);
        if (is_shared && opposite->second.front() < k) continue;  // had from the other side
        body.edges.push_back(
            {start, end, face_of.at(k), is_shared ? face_of.at(opposite->second.front()) : cap});
      }
    }
    if (!rim.empty()) {
      if (open_area.squaredNorm() == 0) return std::nullopt;
      const Vec3 normal = open_area.normalized();
      const HalfSpace plane{normal, normal.dot(rim.front())};
      if (!is_in(plane, rim) || !is_behind(plane, mesh_.vertices)) return std::nullopt;
      body.faces.push_back(plane);
    }
    return is_convex(body, group) ? std::optional(body) : std::nullopt;
  }

  [[nodiscard]] bool is_in(const HalfSpace& plane, const std::vector<Vec3>& points) const {
    return std::all_of(points.begin(), points.end(), [&](const Vec3& point) {
      return std::abs(plane.normal.dot(point) - plane.offset) <= thickness_;
    });
  }

  [[nodiscard]] bool is_behind(const HalfSpace& plane, const std::vector<Vec3>& points) const {
    return std::all_of(points.begin(), points.end(), [&](const Vec3& point) {
      return plane.normal.dot(point) <= plane.offset + thickness_;
    });
  }

  /// Whether all faces are different planes with all corners behind them. A closed surface on the
  /// border of a convex body is all of it.
  [[nodiscard]] bool is_convex(const Blocker& body, const std::vector<Index>& group) const {
    for (std::size_t f = 0; f < body.faces.size(); ++f) {
      for (std::size_t g = 0; g < group.size(); ++g) {
        const std::vector<Vec3>& corners = occluders_[group[g]].corners;
        if (!is_behind(body.faces[f], corners)) return false;
        if (f != g && is_in(body.faces[f], corners)) return false;
      }
    }
    return true;
  }

  const std::vector<Occluder>& occluders_;
  const PatchMesh& mesh_;
  double thickness_;
  DisjointSets groups_;
  std::map<EdgeKey, std::vector<Index>> owners_;
};

}  // namespace

std::vector<Blocker> make_blockers(const std::vector<Occluder>& occluders, const PatchMesh& mesh,
                                   double thickness) {
  return BodyFinder(occluders, mesh, thickness).find();
}

}  // namespace radiosity
