#include "viewer/desk/back_outlines.h"

#include <algorithm>
#include <array>
#include <optional>
#include <tuple>

namespace viewer {
namespace {

using radiosity::Index;
using radiosity::PatchMesh;
using radiosity::Vec3;
using radiosity::Visibility;

constexpr double kSmooth = 0.94;       // cosine of the angle between faces that go on smoothly
constexpr double kTouching = 2e-3;     // of the distance: what meets an edge does not hide it
constexpr Index kMostFaces = 100'000;  // else too many to be told apart, and to be sorted at once
constexpr std::size_t kMostEdges = 1000;
constexpr int kPlaces = 8;  // on an edge, between which it is seen or not
constexpr int kHalvings = 5;
constexpr double kShortest = 0.05;  // of an edge: its ends touch what hides the rest

bool is_before(const Vec3& a, const Vec3& b) {
  return std::tie(a[0], a[1], a[2]) < std::tie(b[0], b[1], b[2]);
}

/// What of an edge nothing hides.
class Sight {
 public:
  Sight(const Vec3& eye, const Visibility& visibility) : eye_(eye), visibility_(visibility) {}

  void add_seen(const Vec3& from, const Vec3& to, std::vector<OutlinePiece>& pieces) const {
    const auto place = [&](double t) -> Vec3 { return from + t * (to - from); };
    std::optional<double> begun;
    if (is_seen(from)) begun = 0;
    double last = 0;
    for (int k = 1; k <= kPlaces; ++k) {
      const double next = static_cast<double>(k) / kPlaces;
      const bool is_next_seen = is_seen(place(next));
      if (is_next_seen != begun.has_value()) {
        const double change = find_change(place, last, next);
        if (begun) {
          if (change - *begun > kShortest) pieces.push_back({place(*begun), place(change)});
          begun.reset();
        } else {
          begun = change;
        }
      }
      last = next;
    }
    if (begun && 1 - *begun > kShortest) pieces.push_back({place(*begun), to});
  }

 private:
  [[nodiscard]] bool is_seen(const Vec3& point) const {
    const Vec3 ray = point - eye_;
    const double distance = ray.norm();
    const auto hit = visibility_.first_front_hit(eye_, ray / distance);
    return !hit || hit->distance > (1 - kTouching) * distance;
  }

  /// Where what is seen changes between two places of which one is.
  template <typename Place>
  double find_change(const Place& place, double low, double high) const {
    const bool is_low_seen = is_seen(place(low));
    for (int k = 0; k < kHalvings; ++k) {
      const double middle = (low + high) / 2;
      (is_seen(place(middle)) == is_low_seen ? low : high) = middle;
    }
    return (low + high) / 2;
  }

  const Vec3& eye_;
  const Visibility& visibility_;
};

}  // namespace

BackOutlines::BackOutlines(const PatchMesh& mesh) {
  if ((mesh.n_polygons() > 0 ? mesh.n_polygons() : mesh.size()) > kMostFaces) return;
  if (mesh.n_polygons() > 0) {
    std::vector<std::int32_t> surfaces(static_cast<std::size_t>(mesh.n_polygons()), 0);
    for (Index i = 0; i < mesh.size(); ++i) surfaces[mesh.polygon[i]] = mesh.surface[i];
    for (Index p = 0; p < mesh.n_polygons(); ++p) {
      add_face(mesh.outline(p), mesh.surface_two_sided[surfaces[p]]);
    }
  } else {
    for (Index i = 0; i < mesh.size(); ++i) {
      std::array<Vec3, 4> corners;
      const int n = mesh.n_corners(i);
      for (int k = 0; k < n; ++k) corners[k] = mesh.corner(i, k);
      add_face(std::span(corners).first(n), mesh.surface_two_sided[mesh.surface[i]]);
    }
  }
  join_edges();
}

void BackOutlines::add_face(std::span<const Vec3> corners, bool is_two_sided) {
  const std::vector<Vec3> points(corners.begin(), corners.end());
  if (points.empty()) return;
  faces_.push_back({points.front(), radiosity::vector_area(points).normalized(), is_two_sided});
  for (std::size_t k = 0; k < points.size(); ++k) {
    const Vec3& a = points[k];
    const Vec3& b = points[(k + 1) % points.size()];
    const bool is_first = is_before(a, b);
    edges_.push_back({is_first ? a : b, is_first ? b : a, {faces_.size() - 1}});
  }
}

/// Takes the edges of faces that meet together, leaves out those where these go on smoothly, and
/// all but the longest of very many.
void BackOutlines::join_edges() {
  std::sort(edges_.begin(), edges_.end(), [](const Edge& a, const Edge& b) {
    return is_before(a.from, b.from) || (a.from == b.from && is_before(a.to, b.to));
  });
  std::vector<Edge> joined;
  for (Edge& edge : edges_) {
    const bool is_same =
        !joined.empty() && joined.back().from == edge.from && joined.back().to == edge.to;
    if (is_same) {
      joined.back().faces.push_back(edge.faces.front());
    } else {
      joined.push_back(std::move(edge));
    }
  }
  std::erase_if(joined, [&](const Edge& edge) {
    return edge.faces.size() == 2 &&
           faces_[edge.faces[0]].normal.dot(faces_[edge.faces[1]].normal) > kSmooth;
  });
  if (joined.size() > kMostEdges) {
    const auto length = [](const Edge& edge) { return (edge.to - edge.from).squaredNorm(); };
    std::nth_element(joined.begin(), joined.begin() + kMostEdges, joined.end(),
                     [&](const Edge& a, const Edge& b) { return length(a) > length(b); });
    joined.resize(kMostEdges);
  }
  edges_ = std::move(joined);
}

std::vector<OutlinePiece> BackOutlines::of_hidden_backs(const Vec3& eye,
                                                        const Visibility& visibility) const {
  const auto is_back = [&](std::size_t f) {
    const Face& face = faces_[f];
    return !face.is_two_sided && face.normal.dot(eye - face.point) < 0;
  };
  const Sight sight(eye, visibility);
  std::vector<OutlinePiece> pieces;
  for (const Edge& edge : edges_) {
    if (std::all_of(edge.faces.begin(), edge.faces.end(), is_back)) {
      sight.add_seen(edge.from, edge.to, pieces);
    }
  }
  return pieces;
}

}  // namespace viewer
