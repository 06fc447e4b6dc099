#include "tests/support/scene_families.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "tests/support/scene_builder.h"
#include "tests/support/scene_random.h"

namespace radiosity::test {
namespace {

/// A plate at a height: one-sided, facing up (0) or down (1), two-sided (2), or a thin solid (3).
void add_plate(Builder& builder, Random& random, int kind, double x0, double x1, double y0,
               double y1, double z) {
  const Points points = rectangle(x0, x1, y0, y1, z);
  switch (kind) {
    case 0:
    case 1:
      builder.add_polygon(builder.add_surface("plate"), kind == 0 ? points : reversed(points));
      builder.result.is_closed = false;
      break;
    case 2:
      builder.add_polygon(builder.add_surface("sheet", true), points);
      break;
    default:
      builder.add_box("slab", {x0, y0, z}, {x1, y1, z + random.log_uniform(1e-3, 2e-2)},
                      any_division(random));
  }
}

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

void make_grid_boxes(Builder& builder, Random& random) {
  const int n = random.integer(2, 4);
  const double cell = random.coin() ? 0.25 : 2.0 / (n + 2);
  const bool has_margin = random.coin();
  const double half = cell * n / 2;
  const double margin = has_margin ? cell : 0;
  builder.add_box("room", Vec3::Constant(-half - margin), Vec3::Constant(half + margin),
                  any_division(random), Piece::hollow);
  builder.result.is_closed = true;
  const double share = random.uniform(0.15, 0.5);
  const Division division =
      random.integer(0, 3) > 0 ? Division::one_surface : Division::surface_per_face;
  int n_boxes = 0;
  for (int x = 0; x < n; ++x) {
    for (int y = 0; y < n; ++y) {
      for (int z = 0; z < n; ++z) {
        if (random.uniform() > share || n_boxes >= 10) continue;
        const auto line = [&](int k) { return k == n ? half : -half + k * cell; };
        const Vec3 low(line(x), line(y), line(z));
        const Vec3 high(line(x + 1), line(y + 1), line(z + 1));
        builder.add_box("box", low, high, division);
        ++n_boxes;
      }
    }
  }
}

void make_turned_boxes(Builder& builder, Random& random) {
  Vec3 low;
  Vec3 high;
  add_room(builder, random, low, high);
  const int n = random.integer(1, 6);
  const Division division = any_division(random);
  std::vector<std::pair<Vec3, double>> spheres;  // Boxes must not cross.
  for (int k = 0; k < n; ++k) {
    const double radius = random.uniform(0.1, 0.4);
    const Vec3 room = 0.5 * (high - low) - Vec3::Constant(radius);
    const Vec3 center = 0.5 * (low + high) + room.cwiseProduct(random.vector(-1, 1));
    const bool is_free = std::all_of(spheres.begin(), spheres.end(), [&](const auto& other) {
      return (other.first - center).norm() > other.second + radius;
    });
    if (!is_free) continue;
    spheres.emplace_back(center, radius);
    Vec3 size = random.vector(0.2, 1);
    size *= radius / size.norm();
    const Eigen::Matrix3d rotation = random.rotation();
    std::vector<Points> faces = box_faces(-size, size);
    for (Points& face : faces) {
      for (Vec3& p : face) p = center + rotation * p;
    }
    builder.add_piece("box", faces, Piece::solid, division);
  }
}

/// Cells of a 3 x 3 plan of uneven widths, 3 to 8 of them and hanging together by their sides, up
/// to one height: its faces, each cell's by itself.
std::vector<Points> recessed_faces(Random& random, const Vec3& corner, double size, double height) {
  constexpr int kCells = 3;
  const int n_cells = random.integer(3, 8);
  std::array<std::array<bool, kCells>, kCells> is_full{};
  const auto full = [&](int x, int y) {
    return x >= 0 && x < kCells && y >= 0 && y < kCells && is_full[x][y];
  };
  is_full[1][0] = true;
  for (int n = 1; n < n_cells;) {
    const int x = random.integer(0, kCells - 1);
    const int y = random.integer(0, kCells - 1);
    const bool is_beside = full(x - 1, y) || full(x + 1, y) || full(x, y - 1) || full(x, y + 1);
    if (is_full[x][y] || !is_beside) continue;
    is_full[x][y] = true;
    ++n;
  }
  std::array<std::array<double, kCells + 1>, 2> line{};
  for (auto& of_axis : line) of_axis = {0, random.uniform(0.2, 0.4), random.uniform(0.6, 0.8), 1};
  const auto at = [&](int x, int y, double z) {
    return Vec3(corner + Vec3(size * line[0][x], size * line[1][y], z));
  };
  std::vector<Points> faces;
  const auto add_side = [&](int x0, int y0, int x1, int y1) {
    faces.push_back({at(x0, y0, 0), at(x1, y1, 0), at(x1, y1, height), at(x0, y0, height)});
  };
  for (int x = 0; x < kCells; ++x) {
    for (int y = 0; y < kCells; ++y) {
      if (!is_full[x][y]) continue;
      const Points bottom{at(x, y, 0), at(x, y + 1, 0), at(x + 1, y + 1, 0), at(x + 1, y, 0)};
      faces.push_back(bottom);
      faces.push_back(
          {at(x, y, height), at(x + 1, y, height), at(x + 1, y + 1, height), at(x, y + 1, height)});
      if (!full(x, y - 1)) add_side(x, y, x + 1, y);
      if (!full(x + 1, y)) add_side(x + 1, y, x + 1, y + 1);
      if (!full(x, y + 1)) add_side(x + 1, y + 1, x, y + 1);
      if (!full(x - 1, y)) add_side(x, y + 1, x, y);
    }
  }
  return faces;
}

void make_recessed(Builder& builder, Random& random) {
  Vec3 low;
  Vec3 high;
  add_room(builder, random, low, high);
  const int n_solids = random.integer(1, 2);
  for (int k = 0; k < n_solids; ++k) {
    // On the floor or above it, against a wall or off it.
    const Vec3 corner(low.x() + (random.coin() ? 0 : random.uniform(0.1, 0.2)),
                      low.y() + 0.1 + 0.65 * k,
                      low.z() + (random.coin() ? 0 : random.uniform(0.05, 0.15)));
    const double size = random.uniform(0.4, 0.6);
    const double height = random.uniform(0.2, 0.8);
    builder.add_piece("solid", recessed_faces(random, corner, size, height), Piece::solid,
                      Division::one_surface);
  }
}

void make_prisms(Builder& builder, Random& random) {
  const bool has_room = random.integer(0, 3) > 0;
  Vec3 low(-1, -1, -0.8);
  Vec3 high(1, 1, 0.8);
  if (has_room) add_room(builder, random, low, high);
  const std::array sides{3, 4, 5, 6, 8, 12, 24, 48, 96};
  const int n_prisms = random.integer(1, 3);
  const bool are_plates = random.integer(0, 2) == 0;
  for (int k = 0; k < n_prisms; ++k) {
    const int n = sides[random.integer(0, are_plates || n_prisms == 1 ? 8 : 6)];
    if (are_plates) {
      const Points plate =
          regular_polygon(n, random.uniform(0.2, 0.6), {0, 0, -0.4 + 0.3 * k}, random.uniform());
      const int kind = random.integer(0, 2);
      builder.add_polygon(builder.add_surface("plate", kind == 2),
                          kind == 1 ? reversed(plate) : plate);
      if (kind < 2) builder.result.is_closed = false;
      continue;
    }
    const double radius = random.uniform(0.1, 0.25);
    const Vec3 center(-0.4 + 0.4 * k, random.uniform(-0.3, 0.3),
                      random.coin() ? low.z() : low.z() + 0.1);
    const double phase = random.uniform();
    const Points bottom = regular_polygon(n, 0.75 * radius, center, phase);
    builder.add_piece("prism", prism_faces(bottom, 0.4 * Vec3::UnitZ()), Piece::solid,
                      n <= 6 && random.coin() ? Division::surface_per_face : Division::one_surface);
  }
}

/// An icosahedron whose triangles are divided into four, `level` times; corners on the unit sphere.
std::vector<Points> sphere_triangles(int level) {
  const double g = (1 + std::sqrt(5.0)) / 2;
  const Points p{{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                 {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  constexpr std::array<std::array<int, 3>, 20> kTriangles{
      {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
       {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
       {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}};
  std::vector<Points> triangles;
  for (const auto& t : kTriangles) {
    triangles.push_back({p[t[0]].normalized(), p[t[1]].normalized(), p[t[2]].normalized()});
  }
  for (int k = 0; k < level; ++k) {
    std::vector<Points> finer;
    for (const Points& t : triangles) {
      const Vec3 a = (t[0] + t[1]).normalized();
      const Vec3 b = (t[1] + t[2]).normalized();
      const Vec3 c = (t[2] + t[0]).normalized();
      finer.insert(finer.end(), {{t[0], a, c}, {a, t[1], b}, {c, b, t[2]}, {a, b, c}});
    }
    triangles = std::move(finer);
  }
  return triangles;
}

void make_curved(Builder& builder, Random& random) {
  Vec3 low;
  Vec3 high;
  add_room(builder, random, low, high);
  const int n = random.integer(1, 2);
  for (int k = 0; k < n; ++k) {
    std::vector<Points> triangles = sphere_triangles(random.integer(0, n == 1 ? 2 : 1));
    const double radius = random.uniform(0.15, 0.25);
    const Vec3 center{(k - 0.5 * (n - 1)) * 0.7, random.uniform(-0.2, 0.2),
                      random.uniform(-0.1, 0.1)};
    const double bumps = random.coin() ? 0 : random.uniform(0.1, 0.3);
    const Vec3 wave = 6 * random.direction();
    const double phase = random.uniform(0, 6);
    for (Points& triangle : triangles) {
      // Equal corners of neighbours have equal digits, and so have these.
      for (Vec3& p : triangle) {
        p = center + radius * (1 + bumps * std::sin(wave.dot(p) + phase)) * p;
      }
    }
    builder.add_piece("ball", triangles, Piece::solid, Division::one_surface);
  }
  if (random.coin()) {
    add_plate(builder, random, random.integer(2, 3), -0.4, 0.3, -0.5, 0.4, low.z() + 0.05);
  }
}

/// The boundary of cells of a grid, facing outwards (solid) or inwards (hollow).
std::vector<Points> cell_boundary(const std::array<std::vector<double>, 3>& lines,
                                  const std::function<bool(int, int, int)>& is_filled) {
  const auto filled = [&](const std::array<int, 3>& cell) {
    for (int axis = 0; axis < 3; ++axis) {
      if (cell[axis] < 0 || cell[axis] + 1 >= static_cast<int>(lines[axis].size())) return false;
    }
    return is_filled(cell[0], cell[1], cell[2]);
  };
  std::vector<Points> polygons;
  for (int x = 0; x + 1 < static_cast<int>(lines[0].size()); ++x) {
    for (int y = 0; y + 1 < static_cast<int>(lines[1].size()); ++y) {
      for (int z = 0; z + 1 < static_cast<int>(lines[2].size()); ++z) {
        if (!is_filled(x, y, z)) continue;
        const std::vector<Points> faces =
            box_faces({lines[0][x], lines[1][y], lines[2][z]},
                      {lines[0][x + 1], lines[1][y + 1], lines[2][z + 1]});
        for (int face = 0; face < 6; ++face) {
          std::array neighbour{x, y, z};
          neighbour[face / 2] += face % 2 == 0 ? -1 : 1;
          if (!filled(neighbour)) polygons.push_back(faces[face]);
        }
      }
    }
  }
  return polygons;
}

/// A table, or a chair with a back, as one closed solid.
std::vector<Points> table(Random& random, const Vec3& low, double width, double height) {
  const double leg = random.uniform(0.1, 0.25) * width;
  const double thickness = random.uniform(0.02, 0.05);
  const bool has_back = random.coin();
  std::array<std::vector<double>, 3> lines;
  for (int axis = 0; axis < 2; ++axis) {
    lines[axis] = {low[axis], low[axis] + leg, low[axis] + width - leg, low[axis] + width};
  }
  lines[2] = {low.z(), low.z() + height, low.z() + height + thickness};
  if (has_back) lines[2].push_back(low.z() + 1.8 * height);
  return cell_boundary(lines, [](int x, int y, int z) {
    if (z == 0) return x != 1 && y != 1;
    return z == 1 || x == 0;
  });
}

void make_furniture(Builder& builder, Random& random) {
  Vec3 low;
  Vec3 high;
  if (random.integer(0, 2) == 0) {  // A room in the shape of an L.
    low = {-0.9, -0.8, -0.6};
    high = {0.9, 0.8, 0.6};
    const std::array<std::vector<double>, 3> lines{std::vector{low.x(), 0.1, high.x()},
                                                   std::vector{low.y(), 0.2, high.y()},
                                                   std::vector{low.z(), high.z()}};
    std::vector<Points> walls =
        cell_boundary(lines, [](int x, int y, int) { return x == 0 || y == 0; });
    turn_over(walls);
    builder.add_piece("room", walls, Piece::hollow, any_division(random));
    builder.result.is_closed = true;
  } else {
    add_room(builder, random, low, high);
  }
  const int n = random.integer(1, 2);
  for (int k = 0; k < n; ++k) {
    const Vec3 corner(-0.6 + 0.55 * k, random.uniform(-0.6, -0.3),
                      random.coin() ? low.z() : low.z() + 0.1);
    const double width = random.uniform(0.3, 0.5);
    const double height = random.uniform(0.2, 0.4);
    builder.add_piece("table", table(random, corner, width, height), Piece::solid,
                      Division::one_surface);
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
