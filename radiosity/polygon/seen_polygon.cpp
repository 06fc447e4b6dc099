#include "radiosity/polygon/seen_polygon.h"

#include <algorithm>
#include <cmath>

namespace radiosity {

SeenPolygon::SeenPolygon(const Vec3& point, const ConvexPolygon& polygon) {
  // A corner at the point itself is seen nowhere.
  const auto towards = [&](std::size_t k) {
    const Vec3 way = polygon[k] - point;
    const double length = way.norm();
    return length > 0 ? Vec3(way / length) : Vec3(Vec3::Zero());
  };
  a_ = towards(0);
  Vec3 c = towards(1);
  for (std::size_t k = 1; k + 1 < polygon.size(); ++k) {
    const Vec3 b = c;
    c = towards(k + 1);
    const Vec3 normal_b = a_.cross(b);
    const Vec3 normal_c = a_.cross(c);
    const double lengths = normal_b.norm() * normal_c.norm();
    const double volume = std::abs(a_.dot(b.cross(c)));
    if (!(lengths > 0) || !(volume > 0)) continue;  // seen edge-on
    // Van Oosterom & Strackee 1983
    const double angle = 2 * std::atan2(volume, 1 + a_.dot(b) + b.dot(c) + c.dot(a_));
    const double cosine = normal_b.dot(normal_c) / lengths;
    triangles_[n_triangles_++] = {
        b,    (c - c.dot(a_) * a_).normalized(), a_.dot(b), cosine, volume / lengths, solid_angle_,
        angle};
    solid_angle_ += angle;
  }
}

Vec3 SeenPolygon::direction(double u, double v) const {
  if (n_triangles_ == 0) return a_;
  const double place = u * solid_angle_;
  std::size_t k = 0;
  while (k + 1 < n_triangles_ && place >= triangles_[k + 1].before) ++k;
  const Triangle& t = triangles_[k];
  const double area = std::clamp(place - t.before, 0.0, t.solid_angle);
  // The corner c moves along its arc from a until the triangle has this area.
  const double sine = std::sin(area) * t.cosine - std::cos(area) * t.sine;
  const double cosine = std::cos(area) * t.cosine + std::sin(area) * t.sine;
  const double p = cosine - t.cosine;
  const double q = sine + t.sine * t.cosine_ab;
  const double below = (q * sine + p * cosine) * t.sine;
  const double ratio = ((q * cosine - p * sine) * t.cosine - q) / below;
  const double along = below != 0 ? std::clamp(ratio, -1.0, 1.0) : 1.0;
  const Vec3 c = along * a_ + std::sqrt(1 - along * along) * t.towards_c;
  const double height = 1 - v * (1 - c.dot(t.b));
  const Vec3 across = c - c.dot(t.b) * t.b;
  const double length = across.norm();
  if (!(length > 0)) return t.b;
  return height * t.b + std::sqrt(std::max(0.0, 1 - height * height)) / length * across;
}

}  // namespace radiosity
