#include "tests/support/hung_boxes.h"

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <optional>
#include <random>
#include <string>
#include <vector>

namespace radiosity::test {
namespace {

using Random = std::mt19937_64;

constexpr double kLeastGap = 0.01;    // m
constexpr double kLargestGap = 0.20;  // m

double uniform(Random& random, double low, double high) {
  return low + (high - low) * std::generate_canonical<double, 53>(random);
}

int pick(Random& random, int n) { return static_cast<int>(uniform(random, 0, n)); }

/// A box: its axes are the columns of `axes`.
struct Box {
  Vec3 center;
  Eigen::Matrix3d axes;
  Vec3 half;

  [[nodiscard]] double reach(const Vec3& direction) const {
    return (axes.transpose() * direction).cwiseAbs().dot(half);
  }
};

/// A lower bound of the distance, exact between faces; negative or 0 if they overlap.
double separation(const Box& a, const Box& b) {
  double largest = -1;
  const auto test = [&](const Vec3& direction) {
    const double length = direction.norm();
    if (length < 1e-6) return;
    const Vec3 unit = direction / length;
    const double distance = std::abs((b.center - a.center).dot(unit));
    largest = std::max(largest, distance - a.reach(unit) - b.reach(unit));
  };
  for (int i = 0; i < 3; ++i) {
    test(a.axes.col(i));
    test(b.axes.col(i));
    for (int j = 0; j < 3; ++j) test(a.axes.col(i).cross(b.axes.col(j)));
  }
  return largest;
}

Eigen::Matrix3d random_axes(Random& random) {
  switch (pick(random, 4)) {
    case 0:
      return Eigen::AngleAxisd(uniform(random, 0, 2 * kPi), Vec3::UnitZ()).toRotationMatrix();
    case 1: {
      const double u = uniform(random, 0, 1);
      const double a = uniform(random, 0, 2 * kPi);
      const double b = uniform(random, 0, 2 * kPi);
      return Eigen::Quaterniond(std::sqrt(u) * std::cos(b), std::sqrt(1 - u) * std::sin(a),
                                std::sqrt(1 - u) * std::cos(a), std::sqrt(u) * std::sin(b))
          .toRotationMatrix();
    }
    default:
      return Eigen::Matrix3d::Identity();
  }
}

class HungBoxMaker {
 public:
  explicit HungBoxMaker(std::uint64_t seed) : random_(seed) {
    scene_.source = "hung boxes " + std::to_string(seed);
    scene_.bands.kind = Bands::Kind::grey;
    scene_.closed = true;
    room_.axes.setIdentity();
    room_.half = Vec3(uniform(random_, 1, 2), uniform(random_, 1, 2), uniform(random_, 1, 1.5));
    room_.center.setZero();
  }

  Scene run() {
    for (int face = 0; face < 6; ++face) {
      add_surface("wall " + std::to_string(face), 0);
      add_face(room_, face, true);
    }
    const int n_boxes = 2 + pick(random_, 7);
    for (int i = 0; i < n_boxes; ++i) {
      const std::optional<Box> box = place();
      if (!box) break;
      boxes_.push_back(*box);
      add_surface(i == 0 ? "lamp" : "box " + std::to_string(i), i == 0 ? 100 : 0);
      for (int face = 0; face < 6; ++face) add_face(*box, face, false);
    }
    return std::move(scene_);
  }

 private:
  void add_surface(const std::string& name, double exitance) {
    Material material;
    material.name = name;
    material.reflectance = Eigen::VectorXd::Constant(1, uniform(random_, 0.2, 0.8));
    if (exitance > 0) {
      material.emission.kind = Emission::Kind::exitance;
      material.emission.value = Eigen::VectorXd::Constant(1, exitance);
    }
    scene_.surfaces.push_back({name, static_cast<int>(scene_.materials.size()), false});
    scene_.materials.push_back(material);
  }

  void add_face(const Box& box, int face, bool faces_inwards) {
    const int axis = face / 2;
    const double sign = face % 2 == 0 ? -1 : 1;
    const Vec3 n = sign * box.half[axis] * box.axes.col(axis);
    const Vec3 u = box.half[(axis + 1) % 3] * box.axes.col((axis + 1) % 3);
    Vec3 v = box.half[(axis + 2) % 3] * box.axes.col((axis + 2) % 3);
    if ((sign < 0) != faces_inwards) v = -v;
    const auto first = static_cast<std::int32_t>(scene_.vertices.size());
    const Vec3 middle = box.center + n;
    for (const Vec3& corner : {Vec3(-u - v), Vec3(u - v), Vec3(u + v), Vec3(v - u)}) {
      scene_.vertices.push_back(middle + corner);
    }
    const std::array<std::int32_t, 4> corners = {first, first + 1, first + 2, first + 3};
    scene_.add_polygon(corners, static_cast<std::int32_t>(scene_.surfaces.size() - 1));
  }

  /// A box close to a wall or to another box, if there is room for one.
  std::optional<Box> place() {
    for (int trial = 0; trial < 1000; ++trial) {
      Box box;
      box.half = Vec3::NullaryExpr([&] { return uniform(random_, 0.075, 0.45); });
      box.axes = random_axes(random_);
      const double gap = kLeastGap * std::pow(kLargestGap / kLeastGap, uniform(random_, 0, 1));
      const int axis = pick(random_, 3);
      const double sign = pick(random_, 2) == 0 ? -1 : 1;
      if (boxes_.empty() || pick(random_, 2) == 0) {
        for (int k = 0; k < 3; ++k) {
          const double most = room_.half[k] - box.reach(Vec3::Unit(k));
          box.center[k] = k == axis ? sign * (most - gap) : uniform(random_, -most, most);
        }
      } else {
        const Box& other = boxes_[pick(random_, static_cast<int>(boxes_.size()))];
        if (pick(random_, 2) == 0) box.axes = other.axes;
        const Vec3 normal = sign * other.axes.col(axis);
        box.center = other.center + (other.half[axis] + gap + box.reach(normal)) * normal;
        for (const int k : {(axis + 1) % 3, (axis + 2) % 3}) {
          box.center += uniform(random_, -1, 1) * other.half[k] * other.axes.col(k);
        }
      }
      if (has_room(box)) return box;
    }
    return std::nullopt;
  }

  [[nodiscard]] bool has_room(const Box& box) const {
    for (int k = 0; k < 3; ++k) {
      const double left = room_.half[k] - std::abs(box.center[k]) - box.reach(Vec3::Unit(k));
      if (left < 0.999 * kLeastGap) return false;
    }
    for (const Box& other : boxes_) {
      if (separation(box, other) < 0.999 * kLeastGap) return false;
    }
    return true;
  }

  Random random_;
  Scene scene_;
  Box room_;
  std::vector<Box> boxes_;
};

}  // namespace

Scene make_hung_boxes(std::uint64_t seed) { return HungBoxMaker(seed).run(); }

PatchMesh divided_into_four(const PatchMesh& mesh) {
  PatchMesh result;
  result.surface_names = mesh.surface_names;
  result.surface_two_sided = mesh.surface_two_sided;
  result.precision = mesh.precision;
  result.polygon_corners = mesh.polygon_corners;
  result.first_polygon_corner = mesh.first_polygon_corner;
  const auto add = [&](const std::array<Vec3, 4>& corner, int n, Index parent) {
    std::array<std::int32_t, 4> corners = {-1, -1, -1, -1};
    for (int k = 0; k < n; ++k) {
      corners[k] = static_cast<std::int32_t>(result.vertices.size());
      result.vertices.push_back(corner[k]);
    }
    result.add_patch(corners, mesh.surface[parent], mesh.polygon[parent]);
    result.family.back() = static_cast<std::int32_t>(parent);
  };
  for (Index i = 0; i < mesh.size(); ++i) {
    const int n = mesh.n_corners(i);
    std::array<Vec3, 4> p;
    std::array<Vec3, 4> m;  // middles of the edges
    for (int k = 0; k < n; ++k) {
      p[k] = mesh.corner(i, k);
      m[k] = (p[k] + mesh.corner(i, (k + 1) % n)) / 2;
    }
    if (n == 3) {
      for (int k = 0; k < 3; ++k) add({p[k], m[k], m[(k + 2) % 3], p[k]}, 3, i);
      add({m[0], m[1], m[2], p[0]}, 3, i);
    } else {
      const Vec3 middle = (p[0] + p[1] + p[2] + p[3]) / 4;
      for (int k = 0; k < 4; ++k) add({p[k], m[k], middle, m[(k + 3) % 4]}, 4, i);
    }
  }
  for (Index i = 0; i < result.size(); ++i) {
    const std::int32_t back = mesh.twin[i / 4];
    if (back < 0) continue;
    const auto distance = [&](std::int32_t part) {
      return (result.centroid[part] - result.centroid[i]).squaredNorm();
    };
    std::int32_t nearest = 4 * back;
    for (std::int32_t k = 4 * back + 1; k < 4 * back + 4; ++k) {
      if (distance(k) < distance(nearest)) nearest = k;
    }
    result.twin[i] = nearest;
  }
  return result;
}

Eigen::MatrixXd means_of_four(const PatchMesh& finer, const Eigen::MatrixXd& values) {
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(values.rows() / 4, values.cols());
  for (Index i = 0; i < result.rows(); ++i) {
    double area = 0;
    for (Index k = 4 * i; k < 4 * i + 4; ++k) {
      result.row(i) += finer.area[k] * values.row(k);
      area += finer.area[k];
    }
    result.row(i) /= area;
  }
  return result;
}

IntervalCheck check_intervals(const Solution& solution, const Eigen::MatrixXd& truth,
                              double rounding) {
  std::vector<double> errors;
  std::vector<double> intervals;
  IntervalCheck check;
  for (Index i = 0; i < truth.rows(); ++i) {
    errors.push_back(std::abs(solution.radiosity(i, 0) - truth(i, 0)));
    intervals.push_back(2 * solution.radiosity_error(i, 0));
    if (errors.back() <= intervals.back() + rounding) ++check.n_within;
  }
  const auto median = [](std::vector<double>& values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
  };
  check.error = median(errors);
  check.interval = median(intervals);
  return check;
}

}  // namespace radiosity::test
