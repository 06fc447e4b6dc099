// Sheets back to back hide only what is behind them.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "io/scene/scene_file.h"
#include "meshing/patches/patches.h"
#include "radiosity/assembly/make_dense_transport.h"
#include "radiosity/visibility/visibility.h"

namespace radiosity {
namespace {

using Triangle = std::array<Vec3, 3>;

struct Pair {
  const char* file;
  const char* one;
  const char* other;
};

class BackToBack : public testing::TestWithParam<Pair> {
 protected:
  BackToBack()
      : mesh_(meshing::make_patches(io::read_scene(std::string(RADIOSITY_TEST_DATA) +
                                                   "/back-to-back/" + GetParam().file))) {
    for (Index i = 0; i < mesh_.size(); ++i) {
      for (int k = 2; k < mesh_.n_corners(i); ++k) {
        triangles_.push_back({mesh_.corner(i, 0), mesh_.corner(i, k - 1), mesh_.corner(i, k)});
      }
    }
  }

  [[nodiscard]] std::vector<Index> patches_of(const std::string& surface) const {
    std::vector<Index> result;
    for (Index i = 0; i < mesh_.size(); ++i) {
      if (mesh_.surface_names[mesh_.surface[i]] == surface) result.push_back(i);
    }
    return result;
  }

  [[nodiscard]] Vec3 point_of(Index patch) {
    std::vector<Triangle> parts;
    std::vector<double> areas;
    for (int k = 2; k < mesh_.n_corners(patch); ++k) {
      parts.push_back({mesh_.corner(patch, 0), mesh_.corner(patch, k - 1), mesh_.corner(patch, k)});
      const Triangle& t = parts.back();
      areas.push_back((t[1] - t[0]).cross(t[2] - t[0]).norm());
    }
    const Triangle& t =
        parts[std::discrete_distribution<std::size_t>(areas.begin(), areas.end())(random_)];
    std::uniform_real_distribution<double> uniform;
    double u = uniform(random_);
    double v = uniform(random_);
    if (u + v > 1) {
      u = 1 - u;
      v = 1 - v;
    }
    return t[0] + u * (t[1] - t[0]) + v * (t[2] - t[0]);
  }

  /// But for what is within a thousandth of its ends.
  [[nodiscard]] bool is_free(const Vec3& from, const Vec3& to) const {
    constexpr double kEnd = 1e-3;
    const Vec3 way = to - from;
    return std::none_of(triangles_.begin(), triangles_.end(), [&](const Triangle& t) {
      const Vec3 e = t[1] - t[0];
      const Vec3 f = t[2] - t[0];
      const Vec3 p = way.cross(f);
      const double det = e.dot(p);
      if (det == 0) return false;
      const double u = (from - t[0]).dot(p) / det;
      const Vec3 q = (from - t[0]).cross(e);
      const double v = way.dot(q) / det;
      const double s = f.dot(q) / det;
      return u >= 0 && v >= 0 && u + v <= 1 && s > kEnd && s < 1 - kEnd;
    });
  }

  PatchMesh mesh_;
  std::vector<Triangle> triangles_;
  std::mt19937_64 random_{7};
};

TEST_P(BackToBack, IsSeenAsByRays) {
  constexpr int kRays = 40000;
  const Visibility visibility(mesh_);
  const auto transport = make_dense_transport(mesh_, visibility);
  const Eigen::MatrixXd factors =
      transport->apply(Eigen::MatrixXd::Identity(mesh_.size(), mesh_.size()));
  double exchange = 0;
  double expected = 0;
  double variance = 0;
  for (const Index i : patches_of(GetParam().one)) {
    for (const Index j : patches_of(GetParam().other)) {
      exchange += mesh_.area[i] * factors(i, j);
      double sum = 0;
      double squares = 0;
      for (int k = 0; k < kRays; ++k) {
        const Vec3 x = point_of(i);
        const Vec3 y = point_of(j);
        const Vec3 way = y - x;
        const double r2 = way.squaredNorm();
        const double cosines =
            std::max(0., mesh_.normal[i].dot(way)) * std::max(0., -mesh_.normal[j].dot(way));
        if (cosines == 0 || !is_free(x, y)) continue;
        const double value = mesh_.area[i] * mesh_.area[j] * cosines / (kPi * r2 * r2);
        sum += value;
        squares += value * value;
      }
      expected += sum / kRays;
      variance += (squares / kRays - sum / kRays * (sum / kRays)) / kRays;
    }
  }
  ASSERT_GT(expected, 0);
  EXPECT_NEAR(exchange, expected, 5 * std::sqrt(variance) + 1e-2 * expected);
}

INSTANTIATE_TEST_SUITE_P(Found, BackToBack,
                         testing::Values(Pair{"floating-sheets.json", "x0a", "x1c"},
                                         Pair{"table.json", "top_B", "leg100"},
                                         Pair{"window.json", "room00", "room01"}));

}  // namespace
}  // namespace radiosity
