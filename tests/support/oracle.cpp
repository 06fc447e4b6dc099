#include "tests/support/oracle.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace radiosity::test {
namespace {

/// Positions are judged with so many times the precision of one coordinate: three coordinates of
/// several corners and of both ends are off.
constexpr double kMargin = 10;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

double uniform(std::mt19937_64& random) { return static_cast<double>(random() >> 11) * 0x1p-53; }

Vec3 point_in_triangle(const Vec3& a, const Vec3& b, const Vec3& c, std::mt19937_64& random) {
  const double root = std::sqrt(uniform(random));
  const double t = uniform(random);
  return a + root * ((1 - t) * (b - a) + t * (c - a));
}

/// Evenly distributed in a convex polygon.
Vec3 point_in_polygon(std::span<const Vec3> corners, std::mt19937_64& random) {
  const auto twice_area = [&](std::size_t k) {
    return (corners[k - 1] - corners[0]).cross(corners[k] - corners[0]).norm();
  };
  double sum = 0;
  for (std::size_t k = 2; k < corners.size(); ++k) sum += twice_area(k);
  double rest = sum * uniform(random);
  std::size_t k = 2;
  while (k + 1 < corners.size() && rest > twice_area(k)) rest -= twice_area(k++);
  return point_in_triangle(corners[0], corners[k - 1], corners[k], random);
}

/// The part of a convex polygon in front of the plane inwards · (x - point) = 0.
std::vector<Vec3> clipped(const std::vector<Vec3>& polygon, const Vec3& point,
                          const Vec3& inwards) {
  std::vector<Vec3> result;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec3& a = polygon[k];
    const Vec3& b = polygon[(k + 1) % polygon.size()];
    const double da = inwards.dot(a - point);
    const double db = inwards.dot(b - point);
    if (da >= 0) result.push_back(a);
    if ((da < 0) != (db < 0)) result.push_back(a + da / (da - db) * (b - a));
  }
  return result;
}

}  // namespace

Oracle::Oracle(const FamilyScene& family_scene, const PatchMesh& mesh) : mesh_(mesh) {
  const Scene& scene = family_scene.scene;
  const Box3 box = bounds(mesh);
  center_ = box.center();
  thickness_ = std::max(family_scene.precision, plane_thickness(box));
  margin_ = kMargin * thickness_;
  for (Index k = 0; k < scene.n_polygons(); ++k) add_face(scene, k, family_scene.pieces[k]);
  for (std::size_t k = 0; k < faces_.size(); ++k) add_shapes(static_cast<std::int32_t>(k));
  find_coplanar();
}

void Oracle::add_face(const Scene& scene, Index polygon, Piece piece) {
  Face face;
  face.surface = scene.polygon_surface[polygon];
  face.two_sided = scene.surfaces[face.surface].two_sided;
  face.piece = piece;
  Vec3 sum = Vec3::Zero();
  for (const std::int32_t v : scene.polygon(polygon)) {
    face.corners.push_back(scene.vertices[v] - center_);
    sum += face.corners.back();
  }
  const auto n = face.corners.size();
  face.center = sum / static_cast<double>(n);
  const Vec3 area = vector_area(face.corners);
  face.area = area.norm();
  face.normal = area / face.area;
  face.off_plane = 0;
  face.width = kInfinity;
  for (std::size_t k = 0; k < n; ++k) {
    const Vec3 edge = face.corners[(k + 1) % n] - face.corners[k];
    face.edge_length.push_back(edge.norm());
    face.inwards.push_back(face.normal.cross(edge).normalized());
    double extent = 0;
    for (const Vec3& corner : face.corners) {
      extent = std::max(extent, face.inwards.back().dot(corner - face.corners[k]));
    }
    face.width = std::min(face.width, extent);
    face.off_plane =
        std::max(face.off_plane, std::abs(face.normal.dot(face.corners[k] - face.center)));
  }
  faces_.push_back(std::move(face));
}

void Oracle::add_shapes(std::int32_t index) {
  const auto& c = faces_[index].corners;
  if (c.size() == 4 && (c[0] + c[2] - c[1] - c[3]).norm() <= thickness_) {
    shapes_.add(index, c[0], c[1], c[3], 2);
    return;
  }
  for (std::size_t k = 2; k < c.size(); ++k) shapes_.add(index, c[0], c[k - 1], c[k], 1);
}

void Oracle::find_coplanar() {
  // The wider polygon has the better plane.
  const auto is_in_plane = [this](const Face& narrow, const Face& wide) {
    return std::all_of(narrow.corners.begin(), narrow.corners.end(), [&](const Vec3& corner) {
      return std::abs(wide.normal.dot(corner - wide.center)) <= slack(wide, corner, corner);
    });
  };
  for (std::size_t a = 0; a < faces_.size(); ++a) {
    for (std::size_t b = a + 1; b < faces_.size(); ++b) {
      const bool is_b_wider = faces_[b].width > faces_[a].width;
      if (!is_in_plane(faces_[is_b_wider ? a : b], faces_[is_b_wider ? b : a])) continue;
      faces_[a].coplanar.push_back(static_cast<std::int32_t>(b));
      faces_[b].coplanar.push_back(static_cast<std::int32_t>(a));
    }
  }
}

/// How far off a face's plane a point may be found that lies on it: the plane is known within the
/// digits at its corners and worse further away.
double Oracle::slack(const Face& face, const Vec3& a, const Vec3& b) const {
  const double distance = std::max((a - face.center).norm(), (b - face.center).norm());
  return margin_ * (1 + distance / face.width) + face.off_plane;
}

Vec3 Oracle::random_point(Index patch, std::mt19937_64& random) const {
  std::array<Vec3, 4> corners;
  const int n = mesh_.n_corners(patch);
  for (int k = 0; k < n; ++k) corners[k] = mesh_.corner(patch, k) - center_;
  return point_in_polygon(std::span(corners).first(n), random);
}

double Oracle::height(Index patch, const Vec3& point) const {
  const Face& face = faces_[mesh_.polygon[patch]];
  return mesh_.normal[patch].dot(point - (mesh_.centroid[patch] - center_)) -
         slack(face, point, point);
}

Sight Oracle::sight_past(const Face& face, const Vec3& x, const Vec3& y) const {
  const double hx = face.normal.dot(x - face.center);
  const double hy = face.normal.dot(y - face.center);
  const double thick = slack(face, x, y);
  if (std::min(hx, hy) > thick || std::max(hx, hy) < -thick) return Sight::free;
  // The part of the segment that may be in the plane.
  Vec3 a = x;
  Vec3 b = y;
  const double step = hy - hx;
  const auto at = [&](double level) -> Vec3 {
    return x + std::clamp((level - hx) / step, 0.0, 1.0) * (y - x);
  };
  if (std::abs(step) > 0) {
    a = at(-thick);
    b = at(thick);
  }
  const double distance = std::max((a - face.center).norm(), (b - face.center).norm());
  bool is_inside = true;
  for (std::size_t k = 0; k < face.corners.size(); ++k) {
    const double da = face.inwards[k].dot(a - face.corners[k]);
    const double db = face.inwards[k].dot(b - face.corners[k]);
    const double side = margin_ * (1 + distance / face.edge_length[k]);
    if (std::max(da, db) < -side) return Sight::free;
    is_inside = is_inside && std::min(da, db) > side;
  }
  const bool crosses = hx * hy < 0 && std::min(std::abs(hx), std::abs(hy)) > thick;
  return is_inside && crosses ? Sight::blocked : Sight::grazing;
}

Sight Oracle::sight(Index i, const Vec3& x, Index j, const Vec3& y) const {
  const std::int32_t p = mesh_.polygon[i];
  const std::int32_t q = mesh_.polygon[j];
  const auto is_of_an_end = [&](std::int32_t k) {
    const auto& in_p = faces_[p].coplanar;
    const auto& in_q = faces_[q].coplanar;
    return k == p || k == q || std::binary_search(in_p.begin(), in_p.end(), k) ||
           std::binary_search(in_q.begin(), in_q.end(), k);
  };
  Sight result = Sight::free;
  for (std::size_t k = 0; k < faces_.size(); ++k) {
    const Sight past = sight_past(faces_[k], x, y);
    if (past == Sight::free || is_of_an_end(static_cast<std::int32_t>(k))) continue;
    if (past == Sight::blocked) return Sight::blocked;
    result = Sight::grazing;
  }
  return result;
}

Cover Oracle::position_in(const Face& face, const Vec3& point) const {
  const double distance = (point - face.center).norm();
  Cover result = Cover::yes;
  for (std::size_t k = 0; k < face.corners.size(); ++k) {
    const double inside = face.inwards[k].dot(point - face.corners[k]);
    const double side = margin_ * (1 + distance / face.edge_length[k]);
    if (inside < -side) return Cover::no;
    if (inside <= side) result = Cover::border;
  }
  return result;
}

Cover Oracle::cover(Index patch, const Vec3& point) const {
  Cover result = Cover::no;
  for (const std::int32_t k : faces_[mesh_.polygon[patch]].coplanar) {
    const Face& face = faces_[k];
    if (face.piece != Piece::solid || face.normal.dot(mesh_.normal[patch]) > 0) continue;
    const Cover position = position_in(face, point);
    if (position == Cover::yes) return Cover::yes;
    if (position == Cover::border) result = Cover::border;
  }
  return result;
}

double Oracle::overlap(Index patch, const Face& face) const {
  std::vector<Vec3> part;
  for (int k = 0; k < mesh_.n_corners(patch); ++k) part.push_back(mesh_.corner(patch, k) - center_);
  for (std::size_t k = 0; k < face.corners.size() && part.size() > 2; ++k) {
    part = clipped(part, face.corners[k], face.inwards[k]);
  }
  return part.size() > 2 ? vector_area(part).norm() : 0;
}

template <class Predicate>
double Oracle::share(Index patch, const Predicate& is_cover) const {
  double area = 0;
  for (const std::int32_t k : faces_[mesh_.polygon[patch]].coplanar) {
    const Face& face = faces_[k];
    if (face.normal.dot(mesh_.normal[patch]) > 0 || !is_cover(face.piece)) continue;
    area += overlap(patch, face);
  }
  return area / mesh_.area[patch];
}

double Oracle::covered_share(Index patch) const {
  return share(patch, [](Piece piece) { return piece == Piece::solid; });
}

double Oracle::contact_share(Index patch) const {
  const bool is_solid = faces_[mesh_.polygon[patch]].piece == Piece::solid;
  return share(patch, [&](Piece piece) {
    return piece == Piece::solid || (is_solid && piece == Piece::hollow);
  });
}

void Oracle::shoot_from(std::int32_t start, bool is_back, std::int64_t n_rays,
                        std::mt19937_64& random, RayCounts& counts) const {
  const Face& face = faces_[start];
  const Vec3 normal = is_back ? Vec3(-face.normal) : face.normal;
  RayShapes shapes;
  for (std::size_t k = 0; k < shapes_.size(); ++k) {
    const std::int32_t other = shapes_.face(k);
    if (other == start || std::binary_search(face.coplanar.begin(), face.coplanar.end(), other)) {
      continue;
    }
    const auto& corners = faces_[other].corners;
    if (std::any_of(corners.begin(), corners.end(),
                    [&](const Vec3& c) { return normal.dot(c - face.center) > 0; })) {
      shapes.append(shapes_, k);
    }
  }
  const auto is_covered = [&](const Vec3& point) {
    return std::any_of(face.coplanar.begin(), face.coplanar.end(), [&](std::int32_t k) {
      const Face& other = faces_[k];
      return other.piece == Piece::solid && other.normal.dot(normal) < 0 &&
             std::all_of(other.inwards.begin(), other.inwards.end(), [&](const Vec3& inwards) {
               const std::size_t e = &inwards - other.inwards.data();
               return inwards.dot(point - other.corners[e]) >= 0;
             });
    });
  };
  const Vec3 tangent = normal.unitOrthogonal();
  const Vec3 bitangent = normal.cross(tangent);
  std::vector<double> distances;
  counts.n_rays += n_rays;
  for (std::int64_t ray = 0; ray < n_rays; ++ray) {
    const Vec3 origin = point_in_polygon(face.corners, random);
    const double azimuth = 2 * kPi * uniform(random);
    const double square = uniform(random);
    const Vec3 direction =
        std::sqrt(square) * (std::cos(azimuth) * tangent + std::sin(azimuth) * bitangent) +
        std::sqrt(1 - square) * normal;
    if (is_covered(origin)) {
      ++counts.covered;
      continue;
    }
    shapes.find_hits(origin, direction, distances);
    const auto first = std::min_element(distances.begin(), distances.end());
    if (first == distances.end() || *first == kInfinity) {
      ++counts.escaped;
      continue;
    }
    // Of the polygons in the plane that is met: a front counts, unless a solid's face covers it.
    const auto nearest = static_cast<std::size_t>(first - distances.begin());
    const std::int32_t met = shapes.face(nearest);
    const auto& coplanar = faces_[met].coplanar;
    std::int32_t front = -1;
    bool is_end_covered = false;
    for (std::size_t k = 0; k < shapes.size(); ++k) {
      if (distances[k] == kInfinity) continue;
      const std::int32_t other = shapes.face(k);
      if (other != met && !std::binary_search(coplanar.begin(), coplanar.end(), other)) continue;
      const Face& f = faces_[other];
      const bool is_front = direction.dot(f.normal) < 0;
      if ((is_front || f.two_sided) && front < 0) front = other;
      if (!is_front && f.piece == Piece::solid) is_end_covered = true;
    }
    if (front < 0) {
      ++counts.backs;
    } else if (is_end_covered) {
      ++counts.covered;
    } else {
      ++counts.fronts[faces_[front].surface];
    }
  }
}

RayCounts Oracle::shoot(std::int32_t surface, std::int64_t n_rays, std::uint64_t seed) const {
  RayCounts counts;
  counts.fronts.assign(mesh_.surface_names.size(), 0);
  std::vector<std::int32_t> members;
  double area = 0;
  for (std::size_t k = 0; k < faces_.size(); ++k) {
    if (faces_[k].surface != surface) continue;
    members.push_back(static_cast<std::int32_t>(k));
    area += faces_[k].area;
  }
  // Rays in proportion to area, at places k + u: as even as possible, and right on average.
  std::mt19937_64 random(seed);
  const double shift = uniform(random);
  double sum = 0;
  std::int64_t done = 0;
  for (const std::int32_t member : members) {
    sum += faces_[member].area / area * static_cast<double>(n_rays);
    const auto upto = member == members.back()
                          ? n_rays
                          : std::min(n_rays, static_cast<std::int64_t>(std::floor(sum + shift)));
    const std::int64_t n = upto - done;
    done = upto;
    if (!faces_[member].two_sided) {
      shoot_from(member, false, n, random, counts);
      continue;
    }
    const std::int64_t n_back = n / 2 + (n % 2 == 1 && uniform(random) < 0.5 ? 1 : 0);
    shoot_from(member, false, n - n_back, random, counts);
    shoot_from(member, true, n_back, random, counts);
  }
  return counts;
}

}  // namespace radiosity::test
