#include <algorithm>
#include <array>
#include <cmath>

#include "tests/support/scene_builder.h"

namespace radiosity::test {
namespace {

/// A rectangle that stands in the plane of a y, facing -y.
Points upright(double y, double x0, double x1, double z0, double z1) {
  return {{x0, y, z0}, {x1, y, z0}, {x1, y, z1}, {x0, y, z1}};
}

/// Steps up along x, from side to side in y: every side a column per step, so that ends of edges
/// lie within others.
std::vector<Points> stair_faces(int n_steps, const Vec3& low, const Vec3& high) {
  std::vector<Points> faces;
  const double tread = (high.x() - low.x()) / n_steps;
  const double riser = (high.z() - low.z()) / n_steps;
  for (int k = 0; k < n_steps; ++k) {
    const double x0 = low.x() + k * tread;
    const double x1 = k + 1 < n_steps ? low.x() + (k + 1) * tread : high.x();
    const double z0 = low.z() + k * riser;
    const double z1 = k + 1 < n_steps ? low.z() + (k + 1) * riser : high.z();
    faces.push_back(rectangle(x0, x1, low.y(), high.y(), z1));
    faces.push_back({{x0, low.y(), z0}, {x0, low.y(), z1}, {x0, high.y(), z1}, {x0, high.y(), z0}});
    faces.push_back(upright(low.y(), x0, x1, low.z(), z1));
    faces.push_back(reversed(upright(high.y(), x0, x1, low.z(), z1)));
  }
  faces.push_back(reversed(rectangle(low.x(), high.x(), low.y(), high.y(), low.z())));
  faces.push_back({{high.x(), low.y(), low.z()},
                   {high.x(), high.y(), low.z()},
                   {high.x(), high.y(), high.z()},
                   {high.x(), low.y(), high.z()}});
  return faces;
}

/// A wall from y = low to high around an opening in x and z.
std::vector<Points> wall_with_opening(const Vec3& low, const Vec3& high, double x0, double x1,
                                      double z0, double z1) {
  const std::array xs{low.x(), x0, x1, high.x()};
  const std::array zs{low.z(), z0, z1, high.z()};
  std::vector<Points> faces = box_faces(low, high);
  faces.erase(faces.begin() + 2, faces.begin() + 4);  // -y, +y
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) {
      if (i == 1 && k == 1) continue;
      faces.push_back(upright(low.y(), xs[i], xs[i + 1], zs[k], zs[k + 1]));
      faces.push_back(reversed(upright(high.y(), xs[i], xs[i + 1], zs[k], zs[k + 1])));
    }
  }
  std::vector<Points> reveal = box_faces({x0, low.y(), z0}, {x1, high.y(), z1});
  reveal.erase(reveal.begin() + 2, reveal.begin() + 4);
  turn_over(reveal);
  faces.insert(faces.end(), reveal.begin(), reveal.end());
  return faces;
}

}  // namespace

void make_louvres(Builder& builder, Random& random) {
  Vec3 low;
  Vec3 high;
  add_room(builder, random, low, high);
  const int n = random.integer(3, 12);
  const double pitch = 1.1 / n;
  const double angle = random.integer(0, 3) == 0 ? 0 : random.uniform(0.3, kPi - 0.3);
  // No further than the room's walls.
  const double width =
      std::min(0.3, pitch * (angle == 0 ? random.uniform(0.4, 1) : random.uniform(0.4, 1.8)));
  const double thickness = pitch * random.log_uniform(0.005, 0.15);
  const double y0 = -random.uniform(0.2, 0.5);
  const double y1 = random.uniform(0.2, 0.5);
  const bool are_sheets = random.integer(0, 3) == 0;
  const Division division = any_division(random);
  const Vec3 along(std::cos(angle), 0, std::sin(angle));
  const Vec3 across(-along.z(), 0, along.x());
  for (int k = 0; k < n; ++k) {
    const Vec3 center(-0.5 + pitch * k, 0, 0);
    const auto corner = [&](double s, double t) {
      return Vec3(center + 0.5 * width * s * along + 0.5 * thickness * t * across);
    };
    if (are_sheets) {
      const Vec3 a = corner(-1, 0);
      const Vec3 b = corner(1, 0);
      builder.add_polygon(
          builder.add_surface("slat", true),
          {{a.x(), y0, a.z()}, {b.x(), y0, b.z()}, {b.x(), y1, b.z()}, {a.x(), y1, a.z()}});
      continue;
    }
    Points end{corner(-1, -1), corner(-1, 1), corner(1, 1), corner(1, -1)};
    for (Vec3& p : end) p.y() = y0;
    builder.add_piece("slat", prism_faces(end, (y1 - y0) * Vec3::UnitY()), Piece::solid, division);
  }
  if (random.coin()) return;
  // The slats end on boards.
  const double reach = 0.5 * width + thickness + 0.02;
  builder.add_box("end", {-0.68, y0 - 0.03, -reach}, {0.68, y0, reach}, division);
  builder.add_box("end", {-0.68, y1, -reach}, {0.68, y1 + 0.03, reach}, division);
}

void make_stairs(Builder& builder, Random& random) {
  Vec3 low;
  Vec3 high;
  add_room(builder, random, low, high);
  const int n_steps = random.integer(2, 7);
  const double raised = random.coin() ? 0 : random.uniform(0.02, 0.1);
  const double off_wall = random.coin() ? 0 : random.uniform(0.01, 0.2);
  const Vec3 foot(random.uniform(-0.4, -0.1), low.y() + off_wall, low.z() + raised);
  const Vec3 top(random.coin() ? high.x() : random.uniform(0.3, 0.6), foot.y() + 0.5,
                 foot.z() + random.uniform(0.3, 0.8));
  builder.add_piece("stairs", stair_faces(n_steps, foot, top), Piece::solid, any_division(random));
  if (random.coin()) {
    // A board that leans on the side of the stairs.
    builder.add_box("board", {foot.x() + 0.1, top.y(), low.z()},
                    {top.x() - 0.05, top.y() + 0.02, random.uniform(top.z(), top.z() + 0.3)},
                    any_division(random));
  }
  if (random.coin()) {
    // A box on the second step.
    const double tread = (top.x() - foot.x()) / n_steps;
    const double z = foot.z() + (top.z() - foot.z()) / n_steps * 2;
    const double x0 = foot.x() + tread * (n_steps == 2 ? 0.2 + 1 : 1.2);
    builder.add_box("box", {x0, foot.y() + 0.1, z}, {x0 + 0.6 * tread, foot.y() + 0.3, z + 0.1},
                    any_division(random));
  }
}

void make_pipes(Builder& builder, Random& random) {
  Vec3 low;
  Vec3 high;
  add_room(builder, random, low, high);
  const int n_pipes = random.integer(1, 4);
  for (int k = 0; k < n_pipes; ++k) {
    const int n = std::array{3, 4, 6, 8, 12, 24}[random.integer(0, 5)];
    const double radius = random.uniform(0.03, 0.12);
    const double length = random.uniform(0.4, 1);
    Points end = regular_polygon(n, radius, Vec3::Zero(), random.uniform(0, 2 * kPi));
    const bool lies = random.coin();
    if (lies) {
      // By an edge, or by a face where two corners are lowest, on the floor.
      end = regular_polygon(n, radius, Vec3::Zero(), random.coin() ? 0 : kPi / n);
      double least = 0;
      for (const Vec3& p : end) least = std::min(least, p.x());
      for (Vec3& p : end) {
        const double height = std::abs(p.x() - least) < 1e-12 ? 0 : p.x() - least;
        p = Vec3(-0.5 * length, -0.45 + 0.3 * k + p.y(), low.z() + height);
      }
      builder.add_piece("pipe", prism_faces(reversed(end), length * Vec3::UnitX()), Piece::solid,
                        Division::one_surface);
      continue;
    }
    const Eigen::Matrix3d rotation =
        Eigen::AngleAxisd(random.uniform(0, kPi), Vec3::UnitY()).toRotationMatrix();
    const double half = 0.4 * length;
    for (Vec3& p : end) {
      p = Vec3(0, -0.45 + 0.3 * k, 0.1) + rotation * Vec3(p.x(), p.y(), -half);
    }
    builder.add_piece("pipe", prism_faces(end, rotation * Vec3(0, 0, 2 * half)), Piece::solid,
                      Division::one_surface);
  }
}

void make_windows(Builder& builder, Random& random) {
  Vec3 low;
  Vec3 high;
  add_room(builder, random, low, high);
  const double y = random.uniform(-0.2, 0.2);
  const double depth = random.log_uniform(0.01, 0.2);
  const double x0 = random.uniform(-0.4, -0.1);
  const double x1 = random.uniform(0.1, 0.4);
  const double z0 = random.uniform(-0.3, -0.1);
  const double z1 = random.uniform(0.1, 0.4);
  // From wall to wall and floor to ceiling, or free on some sides.
  const Vec3 from(random.coin() ? low.x() : -0.6, y, random.coin() ? low.z() : -0.45);
  const Vec3 to(random.coin() ? high.x() : 0.6, y + depth, random.coin() ? high.z() : 0.45);
  builder.add_piece("wall", wall_with_opening(from, to, x0, x1, z0, z1), Piece::solid,
                    any_division(random));
  const int kind = random.integer(0, 3);
  if (kind == 0) return;
  const double bar = random.uniform(0.01, 0.04);
  const double at = y + depth * random.uniform(0, 0.5);
  const double back = at + depth * random.uniform(0.1, 0.5);
  const double middle = random.uniform(-0.05, 0.05);
  // Mullion and transom, or slats, in the opening: they end on its reveals.
  builder.add_box("mullion", {middle - bar, at, z0}, {middle + bar, back, z1},
                  any_division(random));
  if (kind == 1) return;
  const int n_bars = random.integer(1, 4);
  for (int k = 1; k <= n_bars; ++k) {
    const double z = z0 + (z1 - z0) * k / (n_bars + 1);
    builder.add_box("bar", {x0, at, z}, {middle - bar, back, z + 0.2 * bar}, any_division(random));
    if (kind == 3) {
      builder.add_box("bar", {middle + bar, at, z}, {x1, back, z + 0.2 * bar},
                      any_division(random));
    }
  }
}

void make_wedges(Builder& builder, Random& random) {
  Vec3 low;
  Vec3 high;
  add_room(builder, random, low, high);
  const double floor = random.coin() ? low.z() : low.z() + 0.05;
  const double length = random.uniform(0.4, 0.8);
  const double height = random.uniform(0.1, 0.5);
  const double y0 = random.uniform(-0.5, -0.2);
  const double y1 = random.uniform(0, 0.3);
  // A ramp, and another upside down upon its slope, perhaps moved along it.
  const Points side{{-0.4, y0, floor}, {-0.4 + length, y0, floor}, {-0.4, y0, floor + height}};
  builder.add_piece("ramp", prism_faces(reversed(side), (y1 - y0) * Vec3::UnitY()), Piece::solid,
                    any_division(random));
  if (random.coin()) {
    const double shift = random.coin() ? 0 : random.uniform(-0.3, 0);
    const Vec3 along = shift * Vec3(length, 0, -height);
    const double inset = random.coin() ? 0 : random.uniform(0.02, 0.1);
    Points other{side[1], side[2] + Vec3(length, 0, 0), side[2]};
    for (Vec3& p : other) {
      p += along;
      p.y() += inset;
    }
    std::reverse(other.begin(), other.end());
    builder.add_piece("counter", prism_faces(other, (y1 - y0 - 2 * inset) * Vec3::UnitY()),
                      Piece::solid, any_division(random));
  }
  const int n_pyramids = random.integer(0, 2);
  for (int k = 0; k < n_pyramids; ++k) {
    const Points base = regular_polygon(random.integer(3, 6), random.uniform(0.05, 0.12),
                                        {-0.2 + 0.4 * k, 0.45, low.z()}, random.uniform(0, 6));
    const Vec3 tip(-0.2 + 0.4 * k, 0.45, low.z() + random.uniform(0.1, 0.4));
    std::vector<Points> faces{reversed(base)};
    for (std::size_t c = 0; c < base.size(); ++c) {
      faces.push_back({base[c], base[(c + 1) % base.size()], tip});
    }
    builder.add_piece("pyramid", faces, Piece::solid, any_division(random));
  }
}

void make_nested(Builder& builder, Random& random) {
  Vec3 low;
  Vec3 high;
  add_room(builder, random, low, high);
  const Division division = any_division(random);
  const Vec3 corner(random.uniform(-0.5, -0.3), random.uniform(-0.5, -0.3),
                    random.coin() ? low.z() : -0.35);
  const Vec3 opposite(random.uniform(0.2, 0.5), random.uniform(0.2, 0.5), random.uniform(0.1, 0.4));
  const double wall = random.log_uniform(0.005, 0.1);
  const Vec3 inner_low = corner + Vec3::Constant(wall);
  const Vec3 inner_high = opposite - Vec3::Constant(wall);
  if (random.coin()) {
    builder.add_box("shell", corner, opposite, division);
    builder.add_box("hollow", inner_low, inner_high, division, Piece::hollow);
  } else {
    // Six boards, with a slit below the lid or without.
    const double slit = random.coin() ? 0 : random.log_uniform(0.005, 0.05);
    const double top = inner_high.z();
    builder.add_box("board", corner, {opposite.x(), opposite.y(), inner_low.z()}, division);
    builder.add_box("lid", {corner.x(), corner.y(), top}, opposite, division);
    const double z0 = inner_low.z();
    const double z1 = top - slit;
    builder.add_box("side", {corner.x(), corner.y(), z0}, {inner_low.x(), opposite.y(), z1},
                    division);
    builder.add_box("side", {inner_high.x(), corner.y(), z0}, {opposite.x(), opposite.y(), z1},
                    division);
    builder.add_box("side", {inner_low.x(), corner.y(), z0}, {inner_high.x(), inner_low.y(), z1},
                    division);
    builder.add_box("side", {inner_low.x(), inner_high.y(), z0}, {inner_high.x(), opposite.y(), z1},
                    division);
  }
  if (random.coin()) {
    // On the inner floor or above it.
    const Vec3 size = inner_high - inner_low;
    const double z = inner_low.z() + (random.coin() ? 0 : 0.1 * size.z());
    const Vec3 at(inner_low.x() + 0.3 * size.x(), inner_low.y() + 0.2 * size.y(), z);
    builder.add_box("content", at, at + 0.3 * size, division);
  }
}

}  // namespace radiosity::test
