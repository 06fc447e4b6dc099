#include "tests/support/scene_families.h"

#include <algorithm>
#include <cmath>

#include "tests/support/scene_builder.h"
#include "tests/support/scene_random.h"

namespace radiosity::test {
namespace {

void make_plates(Builder& builder, Random& random) {
  const int n = random.integer(2, 6);
  const bool is_uniform = random.coin();
  const int kind = random.integer(0, 4);  // 0: up below, else down; 1: up or down; 4: any
  Vec3 low(-0.5, -0.5, -0.9);
  Vec3 high(0.5, 0.5, 0.9);
  if (random.integer(0, 2) == 0) add_room(builder, random, low, high);
  const double gap = (high.z() - low.z()) / (n + 1);
  for (int k = 0; k < n; ++k) {
    const double z = low.z() + gap * (k + (is_uniform ? 1 : random.uniform(0.6, 1.3)));
    const double half_x = is_uniform ? 0.45 : random.uniform(0.1, 0.45);
    const double half_y = is_uniform ? 0.45 : random.uniform(0.1, 0.45);
    const std::array kinds{k == 0 ? 0 : 1, random.integer(0, 1), 2, 3, random.integer(0, 3)};
    const int this_kind = kinds[kind];
    add_plate(builder, random, this_kind, -half_x, half_x, -half_y, half_y, z);
  }
}

void make_storeys(Builder& builder, Random& random) {
  const std::array<int, 3> n{random.integer(1, 2), 1, random.integer(1, 2)};
  const int n_x = n[0] * n[2] == 1 ? 2 : n[0];
  const std::array gaps{0.0, 1e-3, 0.05};
  const double wall_x = gaps[random.integer(0, 2)];
  const double wall_z = gaps[random.integer(0, 2)];
  const double width = 1.8 / n_x;
  const double height = 1.6 / n[2];
  const Division division = any_division(random);
  builder.result.is_closed = true;
  for (int ix = 0; ix < n_x; ++ix) {
    for (int iz = 0; iz < n[2]; ++iz) {
      const Vec3 low(-0.9 + ix * width, -0.6, -0.8 + iz * height);
      const Vec3 high(low.x() + width - (ix + 1 < n_x ? wall_x : 0), 0.6,
                      low.z() + height - (iz + 1 < n[2] ? wall_z : 0));
      // Where walls meet back to back, both are at one coordinate.
      Vec3 snapped = high;
      if (wall_x == 0 && ix + 1 < n_x) snapped.x() = -0.9 + (ix + 1) * width;
      if (wall_z == 0 && iz + 1 < n[2]) snapped.z() = -0.8 + (iz + 1) * height;
      builder.add_box("room", low, snapped, division, Piece::hollow);
      const Vec3 size = snapped - low;
      switch (random.integer(0, 2)) {
        case 0:
          builder.add_box("box", low + 0.2 * size, low + 0.6 * size, any_division(random));
          break;
        case 1:
          add_plate(builder, random, random.integer(2, 3), low.x() + 0.1 * size.x(),
                    low.x() + 0.5 * size.x(), -0.3, 0.4, low.z() + 0.5 * size.z());
          break;
        default:
          break;
      }
    }
  }
}

void make_lamps(Builder& builder, Random& random) {
  Vec3 low;
  Vec3 high;
  add_room(builder, random, low, high);
  const int n = random.integer(1, 4);
  for (int k = 0; k < n; ++k) {
    const double step = (high.x() - low.x()) / n;
    const double x0 = low.x() + step * (k + random.uniform(0.1, 0.3));
    const double x1 = low.x() + step * (k + random.uniform(0.6, 0.9));
    const double depth = random.log_uniform(2e-3, 0.1);
    // A thin solid ends half-way between its lower side and the ceiling.
    const double z = high.z() - depth;
    switch (random.integer(0, 2)) {
      case 0:
        add_plate(builder, random, 1, x0, x1, -0.4, 0.3, z);
        break;
      case 1:
        add_plate(builder, random, 2, x0, x1, -0.4, 0.3, z);
        break;
      default:
        builder.add_box("lamp", {x0, -0.4, z}, {x1, 0.3, z + depth / 2}, any_division(random));
    }
  }
  if (random.coin()) {
    builder.add_box("box", {-0.3, -0.3, low.z()}, {0.2, 0.3, low.z() + 0.3}, any_division(random));
  }
}

void make_shelves(Builder& builder, Random& random) {
  double floor = -0.7;
  if (random.integer(0, 3) > 0) {
    Vec3 low;
    Vec3 high;
    add_room(builder, random, low, high);
    floor = random.coin() ? low.z() : low.z() + 0.05;
  }
  const double thickness = random.uniform(0.02, 0.06);
  const double top = floor + random.uniform(0.8, 0.95);
  const double depth = random.uniform(0.15, 0.3);
  const bool has_divider = random.coin();
  const int n_bays = has_divider ? 2 : 1;
  const Division division = any_division(random);
  std::vector<double> panels{-0.6};
  for (int bay = 1; bay <= n_bays; ++bay) panels.push_back(-0.6 + 1.1 * bay / n_bays);
  for (const double x : panels) {
    builder.add_box("panel", {x, -depth, floor}, {x + thickness, depth, top}, division);
  }
  const bool is_in_line = random.coin();
  const int n_boards = random.integer(1, 4);
  for (int bay = 0; bay < n_bays; ++bay) {
    const double from = panels[bay] + thickness;
    const double to = panels[bay + 1];
    for (int k = 0; k < n_boards; ++k) {
      const double z =
          floor + (top - floor) * (k + (is_in_line ? 0.5 : random.uniform(0.2, 0.8))) / n_boards;
      const double front = is_in_line ? depth : random.uniform(0, depth);
      builder.add_box("board", {from, -front, z}, {to, front, z + 0.9 * thickness}, division);
    }
  }
  if (random.coin()) {
    builder.add_box("back", {-0.6, depth, floor}, {panels.back() + thickness, depth + 0.02, top},
                    division);
  }
}

void make_stacks(Builder& builder, Random& random) {
  Vec3 low(-0.9, -0.9, -0.9);
  Vec3 high(0.9, 0.9, 0.9);
  const bool has_room = random.integer(0, 3) > 0;
  if (has_room) add_room(builder, random, low, high);
  const double floor = low.z();
  if (random.coin()) {  // Boxes upon each other, wholly or partly.
    double z = floor;
    const int n = random.integer(2, 4);
    const double room_for_each = (high.z() - low.z() - 0.1) / n;
    double half = 0.4;
    Vec3 center(0, 0, 0);
    for (int k = 0; k < n; ++k) {
      const double height = random.uniform(0.4, 0.9) * room_for_each;
      builder.add_box("box", {center.x() - half, center.y() - half, z},
                      {center.x() + half, center.y() + half, z + height}, any_division(random));
      z += height;
      const int next = random.integer(0, 2);  // as large, smaller, moved aside
      if (next == 1) half *= random.uniform(0.4, 0.9);
      if (next == 2) {
        const double reach = 0.5 - half;  // A wall may stand at x = 0.55.
        center.x() = std::clamp(center.x() + random.uniform(-0.5, 0.5) * half, -reach, reach);
      }
    }
  } else {  // Legs and a top, each a solid of its own.
    const double height = random.uniform(0.2, 0.5);
    const double width = random.uniform(0.03, 0.1);
    const double inset = random.coin() ? 0 : random.uniform(0.01, 0.1);
    const double x0 = -0.5 + inset;
    const double y0 = -0.4 + inset;
    const Division division = any_division(random);
    for (const double x : {x0, -x0 - width}) {
      for (const double y : {y0, -y0 - width}) {
        builder.add_box("leg", {x, y, floor}, {x + width, y + width, floor + height}, division);
      }
    }
    builder.add_box("top", {-0.5, -0.4, floor + height}, {0.5, 0.4, floor + height + 0.05},
                    division);
    if (random.coin()) {
      builder.add_box("box", {-0.2, -0.2, floor + height + 0.05}, {0.1, 0.2, floor + height + 0.3},
                      any_division(random));
    }
  }
  if (has_room && random.coin()) {  // A wall from floor to ceiling or less.
    const double top = random.coin() ? high.z() : floor + 0.5;
    const double end = random.coin() ? high.y() : 0.5;
    builder.add_box("wall", {0.55, low.y() + 0.1, floor}, {0.6, end, top}, any_division(random));
  }
}

void make_crossing(Builder& builder, Random& random) {
  const bool has_room = random.coin();
  Vec3 low;
  Vec3 high;
  if (has_room) add_room(builder, random, low, high);
  const int n = random.integer(4, 14);
  const bool has_needles = random.integer(0, 2) == 0;
  for (int k = 0; k < n; ++k) {
    const double half = random.log_uniform(0.05, 0.5);
    const Vec3 center = random.vector(-0.2, 0.2);
    const Eigen::Matrix3d rotation = random.rotation();
    const double width = has_needles && random.coin() ? half * random.log_uniform(1e-5, 1e-2)
                                                      : half * random.uniform(0.3, 1);
    Points points{{-half, -width, 0}, {half, -width, 0}, {half, width, 0}, {-half, width, 0}};
    if (random.coin()) points.pop_back();
    const double shrink = 0.5 / std::max(0.5, std::hypot(half, width));
    for (Vec3& p : points) {
      p = center + shrink * (rotation * p);
      // Plates that pass through a wall are in part outside.
      const bool is_within = (p.array() > low.array()).all() && (p.array() < high.array()).all();
      if (has_room && !is_within) builder.result.is_closed = false;
    }
    const bool two_sided = has_room || random.coin();
    builder.add_polygon(builder.add_surface("plate", two_sided), points);
  }
}

void make_canyon(Builder& builder, Random& random) {
  const double ground = -0.5;
  builder.add_polygon(builder.add_surface("ground"), rectangle(-1, 1, -1, 1, ground));
  const int n = random.integer(2, 5);
  const bool are_joined = random.coin();
  // Without bottoms, a joined house's wall would look at the ground inside its neighbour.
  const bool has_bottoms = are_joined || random.coin();
  for (const int side : {-1, 1}) {
    const double x0 = side < 0 ? -0.9 : 0.2;
    const double x1 = side < 0 ? -0.2 : 0.9;
    for (int k = 0; k < n; ++k) {
      const double y0 = -0.9 + 1.8 * k / n;
      const double y1 = are_joined ? -0.9 + 1.8 * (k + 1) / n : -0.9 + 1.8 * (k + 0.8) / n;
      const double height = random.uniform(0.2, 0.9);
      std::vector<Points> faces = box_faces({x0, y0, ground}, {x1, y1, ground + height});
      if (!has_bottoms) faces.erase(faces.begin() + 4);
      builder.add_piece(
          "house", faces, has_bottoms ? Piece::solid : Piece::sheet,
          random.integer(0, 2) > 0 ? Division::one_surface : Division::surface_per_face);
    }
  }
}

}  // namespace

std::string_view family_name(Family family) {
  switch (family) {
    case Family::plates:
      return "plates";
    case Family::storeys:
      return "storeys";
    case Family::lamps:
      return "lamps";
    case Family::shelves:
      return "shelves";
    case Family::stacks:
      return "stacks";
    case Family::grid_boxes:
      return "grid boxes";
    case Family::turned_boxes:
      return "turned boxes";
    case Family::prisms:
      return "prisms";
    case Family::recessed:
      return "recessed";
    case Family::curved:
      return "curved";
    case Family::furniture:
      return "furniture";
    case Family::crossing:
      return "crossing";
    case Family::canyon:
      return "canyon";
    case Family::louvres:
      return "louvres";
    case Family::stairs:
      return "stairs";
    case Family::pipes:
      return "pipes";
    case Family::windows:
      return "windows";
    case Family::wedges:
      return "wedges";
    case Family::nested:
      break;
  }
  return "nested";
}

FamilyScene make_family_scene(Family family, std::uint64_t seed) {
  Random random(1000 * seed + static_cast<std::uint64_t>(family));
  Builder builder;
  Scene& scene = builder.result.scene;
  scene.bands.kind = Bands::Kind::grey;
  scene.materials.push_back({"grey", Eigen::VectorXd::Constant(1, 0.5), {}});
  switch (family) {
    case Family::plates:
      make_plates(builder, random);
      break;
    case Family::storeys:
      make_storeys(builder, random);
      break;
    case Family::lamps:
      make_lamps(builder, random);
      break;
    case Family::shelves:
      make_shelves(builder, random);
      break;
    case Family::stacks:
      make_stacks(builder, random);
      break;
    case Family::grid_boxes:
      make_grid_boxes(builder, random);
      break;
    case Family::turned_boxes:
      make_turned_boxes(builder, random);
      break;
    case Family::prisms:
      make_prisms(builder, random);
      break;
    case Family::recessed:
      make_recessed(builder, random);
      break;
    case Family::curved:
      make_curved(builder, random);
      break;
    case Family::furniture:
      make_furniture(builder, random);
      break;
    case Family::crossing:
      make_crossing(builder, random);
      break;
    case Family::canyon:
      make_canyon(builder, random);
      break;
    case Family::louvres:
      make_louvres(builder, random);
      break;
    case Family::stairs:
      make_stairs(builder, random);
      break;
    case Family::pipes:
      make_pipes(builder, random);
      break;
    case Family::windows:
      make_windows(builder, random);
      break;
    case Family::wedges:
      make_wedges(builder, random);
      break;
    case Family::nested:
      make_nested(builder, random);
      break;
  }
  builder.result.name = std::string(family_name(family)) + ", seed " + std::to_string(seed);
  return builder.result;
}

}  // namespace radiosity::test
