#include "tests/support/walled_rooms.h"

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <random>
#include <string>

namespace radiosity::test {
namespace {

constexpr double kReach = 4;  // half the floor, m

class WalledRoomMaker {
 public:
  WalledRoomMaker(std::uint64_t seed, Hut hut) : seed_(seed), hut_(hut), random_(seed) {}

  WalledRoom run() {
    Scene& scene = room_.scene;
    scene.source = "walled room " + std::to_string(seed_);
    scene.bands.kind = Bands::Kind::grey;
    scene.closed = false;
    room_.height = uniform(1.4, 2.2);
    is_of_boards_ = seed_ % 3 == 0;
    lacks_ = hut_ == Hut::sealed ? Lack::nothing : static_cast<Lack>(1 + pick(3));
    add_plan();

    add_surface("floor", false, 0);
    add_quad({-kReach, -kReach, 0}, {2 * kReach, 0, 0}, {0, 2 * kReach, 0});
    add_surface("lamp", false, 100);
    add_quad({-3, -3, 3}, {0, 6, 0}, {6, 0, 0});
    for (std::size_t k = lacks_ == Lack::wall ? 1 : 0; k < room_.plan.size(); ++k) add_wall(k);
    if (lacks_ != Lack::roof) {
      add_surface("roof", true, 0);
      add_quad({-2.2, -2.2, room_.height}, {4.4, 0, 0}, {0, 4.4, 0});
    }
    add_surface("probe", true, 0);
    add_quad(middle_ + Vec3(-0.15, 0.1, 0.5), {0.3, 0, 0.1}, {0, 0.2, 0});
    add_surface("partition", true, 0);
    const double angle = uniform(0, kPi);
    const Vec3 along(std::cos(angle), std::sin(angle), 0);
    add_quad(middle_ - 2 * along - Vec3(0, 0, 0.2), 4 * along, {0, 0, uniform(0.5, 0.9)});
    turn();
    round();
    return std::move(room_);
  }

 private:
  enum class Lack { nothing, wall, roof, gap };

  double uniform(double low, double high) {
    return low + (high - low) * std::generate_canonical<double, 53>(random_);
  }
  int pick(int n) { return static_cast<int>(uniform(0, n)); }
  /// Nothing in one case of two.
  double overhang(double most) { return pick(2) == 0 ? 0 : uniform(0.05, most); }

  void add_plan() {
    const int n = 3 + pick(3);
    const double first = uniform(0, 2 * kPi);
    const Vec3 center(uniform(-0.3, 0.3), uniform(-0.3, 0.3), 0);
    middle_.setZero();
    for (int k = 0; k < n; ++k) {
      const double angle = first + 2 * kPi * (k + uniform(-0.15, 0.15)) / n;
      room_.plan.emplace_back(center + 1.3 * Vec3(std::cos(angle), std::sin(angle), 0));
      middle_ += room_.plan.back() / n;
    }
  }

  void add_surface(const std::string& name, bool two_sided, double exitance) {
    Material material;
    material.name = name;
    material.reflectance = Eigen::VectorXd::Constant(1, exitance > 0 ? 0 : uniform(0.3, 0.8));
    if (exitance > 0) {
      material.emission.kind = Emission::Kind::exitance;
      material.emission.value = Eigen::VectorXd::Constant(1, exitance);
    }
    Scene& scene = room_.scene;
    scene.surfaces.push_back({name, static_cast<int>(scene.materials.size()), two_sided});
    scene.materials.push_back(material);
  }

  void add_quad(const Vec3& corner, const Vec3& u, const Vec3& v) {
    Scene& scene = room_.scene;
    const auto first = static_cast<std::int32_t>(scene.vertices.size());
    for (const Vec3& p : {Vec3(corner), Vec3(corner + u), Vec3(corner + u + v), Vec3(corner + v)}) {
      scene.vertices.push_back(p);
    }
    const std::array<std::int32_t, 4> corners = {first, first + 1, first + 2, first + 3};
    scene.add_polygon(corners, static_cast<std::int32_t>(scene.surfaces.size() - 1));
  }

  void add_wall(std::size_t k) {
    const Vec3& from = room_.plan[k];
    const Vec3& to = room_.plan[(k + 1) % room_.plan.size()];
    const Vec3 along = (to - from).normalized();
    const double before = overhang(0.4);
    const double after = overhang(0.4);
    const double below = lacks_ == Lack::gap && k == 0 ? -0.3 : overhang(0.3);
    const double above = overhang(0.3);
    const Vec3 corner = from - before * along - below * Vec3::UnitZ();
    const Vec3 u = to + after * along - from + before * along;
    const Vec3 v(0, 0, room_.height + below + above);
    add_surface("wall " + std::to_string(k), !is_of_boards_, 0);
    if (!is_of_boards_) return add_quad(corner, u, v);
    const Vec3 w = uniform(0.05, 0.15) * along.cross(Vec3::UnitZ());  // outwards
    add_quad(corner, v, u);
    add_quad(corner + w, u, v);
    add_quad(corner, w, v);
    add_quad(corner + u, v, w);
    add_quad(corner, u, w);
    add_quad(corner + v, w, u);
  }

  void turn() {
    room_.rotation.setIdentity();
    if (seed_ % 2 == 0) return;
    const Vec3 axis(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
    room_.rotation = Eigen::AngleAxisd(uniform(0, kPi), axis.normalized()).toRotationMatrix();
    for (Vec3& vertex : room_.scene.vertices) vertex = room_.rotation * vertex;
  }

  void round() {
    const int kind = static_cast<int>(seed_ / 2 % 3);
    if (kind == 0) return;
    constexpr double kLastPlace = 1e-5;
    for (Vec3& vertex : room_.scene.vertices) {
      for (double& x : vertex) {
        x = kind == 1 ? std::round(x / kLastPlace) * kLastPlace : static_cast<float>(x);
      }
    }
    // Coordinates are below 8 m.
    room_.scene.precision = kind == 1 ? kLastPlace / 2 : std::ldexp(4.0, -24);
  }

  std::uint64_t seed_;
  Hut hut_;
  std::mt19937_64 random_;
  WalledRoom room_;
  Vec3 middle_;  // of the plan
  bool is_of_boards_ = false;
  Lack lacks_ = Lack::nothing;
};

}  // namespace

bool WalledRoom::looks_inside(const PatchMesh& mesh, Index patch) const {
  constexpr double kStep = 1e-3;
  const Vec3 point = rotation.transpose() * (mesh.centroid[patch] + kStep * mesh.normal[patch]);
  if (point.z() < 0 || point.z() > height) return false;
  for (std::size_t k = 0; k < plan.size(); ++k) {
    const Vec3 along = plan[(k + 1) % plan.size()] - plan[k];
    if (along.cross(point - plan[k]).z() < 0) return false;
  }
  return true;
}

WalledRoom make_walled_room(std::uint64_t seed, Hut hut) {
  return WalledRoomMaker(seed, hut).run();
}

}  // namespace radiosity::test
