#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "tests/support/scene_builder.h"

namespace radiosity::test {
namespace {

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

}  // namespace

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

}  // namespace radiosity::test
