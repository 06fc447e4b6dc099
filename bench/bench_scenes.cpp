#include "bench/bench_scenes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <map>
#include <random>
#include <vector>

#include "meshing/patches/patches.h"
#include "radiosity/scene/scene.h"
#include "tests/support/shapes.h"

namespace bench {
namespace {

using radiosity::PatchMesh;
using radiosity::Vec3;
using radiosity::test::Facing;

/// The same surfaces with two triangles for each quad.
PatchMesh halved(const PatchMesh& quads) {
  PatchMesh result;
  result.vertices = quads.vertices;
  result.surface_names = quads.surface_names;
  result.surface_two_sided = quads.surface_two_sided;
  result.precision = quads.precision;
  for (radiosity::Index i = 0; i < quads.size(); ++i) {
    const auto& c = quads.corners[i];
    result.add_patch({c[0], c[1], c[2], -1}, quads.surface[i], quads.polygon[i]);
    if (c[3] < 0) continue;
    result.add_patch({c[0], c[2], c[3], -1}, quads.surface[i], quads.polygon[i]);
  }
  return result;
}

using Rotation = Eigen::Quaterniond;

/// Puts scenes together from solids.
class Builder {
 public:
  Builder() {
    scene_.surfaces = {{"one-sided", 0, false}, {"two-sided", 0, true}};
    scene_.materials = {{"grey", Eigen::VectorXd::Constant(1, 0.5), {}}};
    scene_.bands.kind = radiosity::Bands::Kind::grey;
  }

  void add_polygon(const std::vector<Vec3>& corners, bool is_two_sided = false) {
    std::vector<std::int32_t> indices;
    for (const Vec3& corner : corners) indices.push_back(vertex(corner));
    scene_.add_polygon(indices, is_two_sided ? 1 : surface_);
  }

  /// What follows is of a surface of its own: those of one may meet two at an edge only.
  void start_surface() {
    surface_ = static_cast<std::int32_t>(scene_.surfaces.size());
    scene_.surfaces.push_back({"one-sided " + std::to_string(surface_), 0, false});
  }

  /// A box seen from outside, or a room from inside; `n_faces` 5 leaves the bottom out.
  void add_box(const Vec3& center, const Vec3& half, const Rotation& turn, Facing facing,
               int n_faces = 6) {
    for (int f = 6 - n_faces; f < 6; ++f) {
      const int axis = (f / 2 + 2) % 3;  // the bottom first
      const double side = f % 2 == 0 ? -1 : 1;
      std::vector<Vec3> corners;
      for (const auto& [u, v] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
        Vec3 corner;
        corner[axis] = side * half[axis];
        corner[(axis + 1) % 3] = u * half[(axis + 1) % 3];
        corner[(axis + 2) % 3] = v * half[(axis + 2) % 3];
        corners.push_back(center + turn * corner);
      }
      if ((side < 0) == (facing == Facing::outwards)) std::reverse(corners.begin(), corners.end());
      add_polygon(corners);
    }
  }

  void add_prism(const Vec3& center, double radius, double height, int n_sides,
                 const Rotation& turn) {
    std::vector<Vec3> top;
    std::vector<Vec3> bottom;
    for (int k = 0; k < n_sides; ++k) {
      const double angle = 2 * radiosity::kPi * k / n_sides;
      const Vec3 out(radius * std::cos(angle), radius * std::sin(angle), height / 2);
      top.push_back(center + turn * out);
      bottom.push_back(center + turn * Vec3(out.x(), out.y(), -out.z()));
    }
    for (int k = 0; k < n_sides; ++k) {
      const int next = (k + 1) % n_sides;
      add_polygon({bottom[k], bottom[next], top[next], top[k]});
    }
    add_polygon(top);
    std::reverse(bottom.begin(), bottom.end());
    add_polygon(bottom);
  }

  /// 20 x 4^level triangles; `radius` gives the distance from the centre in each direction.
  void add_ball(const Vec3& center, int level, const std::function<double(const Vec3&)>& radius) {
    const double g = (1 + std::sqrt(5.0)) / 2;
    const std::vector<Vec3> v{{-1, g, 0}, {1, g, 0}, {-1, -g, 0}, {1, -g, 0},
                              {0, -1, g}, {0, 1, g}, {0, -1, -g}, {0, 1, -g},
                              {g, 0, -1}, {g, 0, 1}, {-g, 0, -1}, {-g, 0, 1}};
    constexpr int kFaces[20][3] = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                                   {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                                   {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                                   {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
    const std::function<void(const Vec3&, const Vec3&, const Vec3&, int)> divide =
        [&](const Vec3& a, const Vec3& b, const Vec3& c, int depth) {
          if (depth == 0) {
            const auto place = [&](const Vec3& way) { return Vec3(center + radius(way) * way); };
            add_polygon({place(a), place(b), place(c)});
            return;
          }
          const Vec3 ab = (a + b).normalized();
          const Vec3 bc = (b + c).normalized();
          const Vec3 ca = (c + a).normalized();
          divide(a, ab, ca, depth - 1);
          divide(ab, b, bc, depth - 1);
          divide(ca, bc, c, depth - 1);
          divide(ab, bc, ca, depth - 1);
        };
    for (const auto& face : kFaces) {
      divide(v[face[0]].normalized(), v[face[1]].normalized(), v[face[2]].normalized(), level);
    }
  }

  void round_to(int digits) {
    double largest = 0;
    for (const Vec3& vertex : scene_.vertices) {
      largest = std::max(largest, vertex.cwiseAbs().maxCoeff());
    }
    scene_.precision = 0.5 * std::pow(10, std::floor(std::log10(largest)) + 1 - digits);
    for (Vec3& vertex : scene_.vertices) {
      for (double& x : vertex) {
        char text[40];
        std::snprintf(text, sizeof text, "%.*g", digits, x);
        x = std::strtod(text, nullptr);
      }
    }
  }

  [[nodiscard]] radiosity::Index n_polygons() const { return scene_.n_polygons(); }

  [[nodiscard]] PatchMesh patches(long n_patches) const {
    if (n_patches == 0) return meshing::make_patches(scene_);
    return meshing::make_patches(scene_, {.n_patches = n_patches});
  }

 private:
  std::int32_t vertex(const Vec3& point) {
    const auto next = static_cast<std::int32_t>(scene_.vertices.size());
    const auto [place, is_new] = index_.try_emplace({point.x(), point.y(), point.z()}, next);
    if (is_new) scene_.vertices.push_back(point);
    return place->second;
  }

  radiosity::Scene scene_;
  std::int32_t surface_ = 0;
  std::map<std::array<double, 3>, std::int32_t> index_;
};

Rotation random_turn(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  Eigen::Vector4d q;
  for (double& x : q) x = normal(random);
  return Rotation(q.normalized());
}

Rotation about_z(double angle) { return Rotation(Eigen::AngleAxisd(angle, Vec3::UnitZ())); }

}  // namespace

PatchMesh box_in_box(long n_cells) {
  const auto n = static_cast<int>(n_cells);
  return halved(radiosity::test::box_in_box(n, n / 2));
}

PatchMesh street_canyon(long n_facets) {
  constexpr int kBuildings = 6;
  constexpr double kSide = 18;
  constexpr double kStreet = 12;
  constexpr double kPitch = kSide + kStreet;
  constexpr double kStorey = 3;
  constexpr double kArea = 87e3;  // of everything, m²
  const double cell = std::sqrt(kArea / static_cast<double>(n_facets));
  PatchMesh mesh;
  const auto count = [&](double length) {
    return static_cast<int>(std::max(1L, std::lround(length / cell)));
  };
  const auto add = [&](const Vec3& a, const Vec3& u, const Vec3& v) {
    radiosity::test::add_grid(mesh, a, u, v, count(u.norm()), count(v.norm()));
  };
  const auto add_ground = [&](double x, double y, double wide, double deep) {
    add({x, y, 0}, {wide, 0, 0}, {0, deep, 0});
  };
  for (int j = 0; j < kBuildings; ++j) {
    for (int i = 0; i < kBuildings; ++i) {
      const double x = i * kPitch;
      const double y = j * kPitch;
      const double height = kStorey * (3 + (5 * i + 7 * j + i * j) % 8);
      const Vec3 wide(kSide, 0, 0);
      const Vec3 deep(0, kSide, 0);
      const Vec3 up(0, 0, height);
      const Vec3 corner(x, y, 0);
      add(corner, wide, up);
      add(corner + wide, deep, up);
      add(corner + wide + deep, -wide, up);
      add(corner + deep, -deep, up);
      add(corner + up, wide, deep);
      add_ground(x + kSide, y, kStreet, kSide);
      add_ground(x, y + kSide, kSide, kStreet);
      add_ground(x + kSide, y + kSide, kStreet, kStreet);
    }
  }
  return mesh;
}

PatchMesh turned_boxes(long n_patches, int digits) {
  Builder builder;
  builder.add_box({2, 1.5, 1.25}, {2, 1.5, 1.25}, Rotation::Identity(), Facing::inwards);
  const Vec3 axis(0.3, -0.5, 0.8);
  builder.add_box({1.2, 1.3, 0.9}, {0.4, 0.3, 0.5},
                  Rotation(Eigen::AngleAxisd(0.6, axis.normalized())), Facing::outwards);
  builder.add_box({2.8, 1.7, 1.3}, {0.3, 0.45, 0.35},
                  Rotation(Eigen::AngleAxisd(-1.1, Vec3(1, 1, 0.2).normalized())),
                  Facing::outwards);
  builder.round_to(digits);
  return halved(builder.patches(n_patches));
}

PatchMesh many_boxes(long n_patches) {
  constexpr int kAlongX = 5;
  constexpr int kAlongY = 4;
  constexpr int kAlongZ = 4;
  std::mt19937_64 random(80);
  std::uniform_real_distribution<double> half(0.12, 0.25);
  Builder builder;
  builder.add_box({2.5, 2, 2}, {2.5, 2, 2}, Rotation::Identity(), Facing::inwards);
  for (int i = 0; i < kAlongX; ++i) {
    for (int j = 0; j < kAlongY; ++j) {
      for (int k = 0; k < kAlongZ; ++k) {
        const Vec3 size(half(random), half(random), half(random));
        builder.add_box({i + 0.5, j + 0.5, k + 0.5}, size, random_turn(random), Facing::outwards);
      }
    }
  }
  return builder.patches(n_patches);
}

PatchMesh spheres(long n_patches) {
  Builder builder;
  builder.add_box({2, 1, 1}, {2, 1, 1}, Rotation::Identity(), Facing::inwards);
  builder.add_ball({1.1, 0.9, 0.8}, 3, [](const Vec3&) { return 0.5; });
  builder.add_ball({2.9, 1.1, 1.1}, 3, [](const Vec3&) { return 0.6; });
  return builder.patches(n_patches);
}

PatchMesh bumpy_mesh(long n_patches) {
  Builder builder;
  builder.add_box({2, 2, 2}, {2, 2, 2}, Rotation::Identity(), Facing::inwards);
  builder.add_box({2, 2, 3.9}, {0.3, 0.3, 0.05}, Rotation::Identity(), Facing::outwards);
  builder.add_ball({2, 2, 1.8}, 4, [](const Vec3& way) {
    return 1 + 0.15 * std::sin(5 * way.x() + 1) * std::sin(6 * way.y()) * std::cos(4 * way.z());
  });
  return builder.patches(n_patches);
}

PatchMesh rooms(long n_patches, int n_rooms) {
  Builder builder;
  for (int k = 0; k < n_rooms; ++k) {
    builder.start_surface();
    builder.add_box({4.0 * k + 2, 1.5, 1.25}, {2, 1.5, 1.25}, Rotation::Identity(),
                    Facing::inwards);
    builder.add_box({4.0 * k + 1.8, 1.4, 1.1}, {0.5, 0.3, 0.4}, about_z(0.4), Facing::outwards);
  }
  return builder.patches(n_patches * n_rooms);
}

PatchMesh plates(long n_patches, int n_sides) {
  Builder builder;
  for (int k = 0; k < 3; ++k) {
    std::vector<Vec3> corners;
    for (int side = 0; side < n_sides; ++side) {
      const double angle = 2 * radiosity::kPi * side / n_sides;
      corners.emplace_back(std::cos(angle), std::sin(angle), 0.7 * k);
    }
    builder.add_polygon(corners, true);
  }
  return builder.patches(n_patches);
}

PatchMesh cluttered_room(std::uint64_t seed, long n_patches) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform(0, 1);
  const Vec3 more(uniform(random), uniform(random), uniform(random));
  const Vec3 half = Vec3(1.2, 1, 0.8) + 1.2 * more;
  const auto n_most = static_cast<radiosity::Index>(60 + 134 * uniform(random));
  Builder builder;
  builder.add_box(half, half, Rotation::Identity(), Facing::inwards);
  struct Ball {
    Vec3 center;
    double radius;
  };
  std::vector<Ball> taken;
  for (int attempt = 0; attempt < 4000 && builder.n_polygons() < n_most; ++attempt) {
    const double size = 0.08 + 0.4 * uniform(random) * uniform(random);
    const Vec3 shape =
        size * Vec3(0.3 + uniform(random), 0.3 + uniform(random), 0.3 + uniform(random));
    const double kind = uniform(random);
    const bool stands = kind < 0.4;
    const double radius = shape.norm();
    Vec3 center = Vec3(uniform(random), uniform(random), uniform(random)).cwiseProduct(2 * half);
    if (stands) center.z() = shape.z();
    const bool is_inside = (center.array() > 1.02 * radius).head(stands ? 2 : 3).all() &&
                           (center.array() < 2 * half.array() - 1.02 * radius).all();
    const bool is_free = std::none_of(taken.begin(), taken.end(), [&](const Ball& ball) {
      return (ball.center - center).norm() < 1.02 * (ball.radius + radius);
    });
    if (!is_inside || !is_free) continue;
    taken.push_back({center, radius});
    if (stands) {
      builder.add_box(center, shape, about_z(6 * uniform(random)), Facing::outwards, 5);
    } else if (kind < 0.7) {
      builder.add_box(center, shape, random_turn(random), Facing::outwards);
    } else if (kind < 0.85) {
      builder.add_prism(center, 0.6 * radius, radius, 3 + static_cast<int>(5 * uniform(random)),
                        random_turn(random));
    } else {
      const Rotation turn = random_turn(random);
      const Vec3 u = turn * Vec3(shape.x(), 0, 0);
      const Vec3 v = turn * Vec3(0, shape.y(), 0);
      builder.add_polygon({center - u - v, center + u - v, center + u + v, center - u + v}, true);
    }
  }
  return builder.patches(n_patches);
}

}  // namespace bench
