#include "radiosity/picture/render.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <stop_token>

#include "radiosity/base/parallel.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/visibility/visibility.h"

namespace radiosity {
namespace {

/// Appends a parallelogram of n x n quads that spans `a` and `b` from `origin`; its normal is a x
/// b.
void add_welded_quads(PatchMesh& mesh, const Vec3& origin, const Vec3& a, const Vec3& b, int n,
                      std::int32_t surface = 0) {
  const auto first = static_cast<std::int32_t>(mesh.vertices.size());
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n; ++i) {
      mesh.vertices.emplace_back(origin + a * (double(i) / n) + b * (double(j) / n));
    }
  }
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      const std::int32_t corner = first + j * (n + 1) + i;
      mesh.add_patch({corner, corner + 1, corner + n + 2, corner + n + 1}, surface, 0);
    }
  }
  while (mesh.surface_names.size() <= static_cast<std::size_t>(surface)) {
    mesh.surface_names.emplace_back("wall");
    mesh.surface_two_sided.push_back(false);
  }
}

/// The inside of a box from the origin to `size`, six surfaces (or one) of n x n patches.
PatchMesh make_room(const Vec3& size, int n) {
  PatchMesh mesh;
  const Vec3 x(size[0], 0, 0);
  const Vec3 y(0, size[1], 0);
  const Vec3 z(0, 0, size[2]);
  const Vec3 o = Vec3::Zero();
  add_welded_quads(mesh, o, z, x, n, 0);  // y = 0
  add_welded_quads(mesh, y, x, z, n, 1);
  add_welded_quads(mesh, o, x, y, n, 2);  // z = 0
  add_welded_quads(mesh, z, y, x, n, 3);
  add_welded_quads(mesh, o, y, z, n, 4);  // x = 0
  add_welded_quads(mesh, x, z, y, n, 5);
  return mesh;
}

Eigen::MatrixXd values_at_centroids(const PatchMesh& mesh,
                                    const std::function<double(const Vec3&)>& field) {
  Eigen::MatrixXd values(mesh.size(), 1);
  for (Index i = 0; i < mesh.size(); ++i) values(i, 0) = field(mesh.centroid[i]);
  return values;
}

double largest_corner_error(const PatchMesh& mesh, const Eigen::MatrixXd& corners,
                            const std::function<double(const Vec3&)>& field) {
  double largest = 0;
  for (Index i = 0; i < mesh.size(); ++i) {
    for (int k = 0; k < mesh.n_corners(i); ++k) {
      largest = std::max(largest, std::abs(corners(4 * i + k, 0) - field(mesh.corner(i, k))));
    }
  }
  return largest;
}

/// A unit square of irregular triangles and quads.
PatchMesh make_irregular_square() {
  PatchMesh grid;
  constexpr int kN = 6;
  add_welded_quads(grid, Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY(), kN);
  std::mt19937 random(1);  // a fixed seed
  std::uniform_real_distribution<double> shift(-0.15 / kN, 0.15 / kN);
  for (Vec3& vertex : grid.vertices) {
    for (int axis = 0; axis < 2; ++axis) {
      if (vertex[axis] > 0 && vertex[axis] < 1) vertex[axis] += shift(random);
    }
  }
  PatchMesh mesh;
  mesh.vertices = grid.vertices;
  mesh.surface_names = {"square"};
  for (Index i = 0; i < grid.size(); ++i) {
    const auto [a, b, c, d] = grid.corners[i];
    if (i % 3 == 0) {
      mesh.add_patch({a, b, c, -1}, 0, 0);
      mesh.add_patch({a, c, d, -1}, 0, 0);
    } else {
      mesh.add_patch({a, b, c, d}, 0, 0);
    }
  }
  return mesh;
}

TEST(CornerValues, KeepAConstantFieldExactly) {
  const PatchMesh mesh = make_irregular_square();
  Eigen::MatrixXd values(mesh.size(), 2);
  values.col(0).setConstant(0.1);
  values.col(1).setConstant(1e5 / 3);
  const Eigen::MatrixXd corners = corner_values(mesh, values);
  ASSERT_EQ(corners.rows(), 4 * mesh.size());
  EXPECT_TRUE((corners.col(0).array() == 0.1).all());
  EXPECT_TRUE((corners.col(1).array() == 1e5 / 3).all());
}

TEST(CornerValues, KeepALinearFieldToRounding) {
  const PatchMesh mesh = make_irregular_square();
  const auto field = [](const Vec3& x) { return 5 + 2 * x[0] - x[1]; };
  const Eigen::MatrixXd corners = corner_values(mesh, values_at_centroids(mesh, field));
  EXPECT_LT(largest_corner_error(mesh, corners, field), 1e-13);
}

TEST(CornerValues, ConvergeWithSecondOrder) {
  const auto field = [](const Vec3& x) { return 3 + std::sin(2 * x[0]) * std::cos(x[1]); };
  const auto error = [&](int n) {
    PatchMesh mesh;
    add_welded_quads(mesh, Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY(), n);
    return largest_corner_error(mesh, corner_values(mesh, values_at_centroids(mesh, field)), field);
  };
  // The error tends to c h²; halving h must come close to a quarter.
  EXPECT_LT(error(16), 0.3 * error(8));
  EXPECT_LT(error(32), 0.3 * error(16));
}

TEST(CornerValues, StayWithinNeighborsAtAStep) {
  PatchMesh mesh;
  add_welded_quads(mesh, Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY(), 8);
  const Eigen::MatrixXd values =
      values_at_centroids(mesh, [](const Vec3& x) { return x[0] + 0.3 * x[1] < 0.6 ? 0.0 : 2.0; });
  const Eigen::MatrixXd corners = corner_values(mesh, values);
  EXPECT_GE(corners.minCoeff(), 0);
  for (Index i = 0; i < mesh.size(); ++i) {
    for (int k = 0; k < 4; ++k) {
      const Vec3& x = mesh.corner(i, k);
      // At the border a quarter more is allowed.
      const bool is_inside = x[0] > 0 && x[0] < 1 && x[1] > 0 && x[1] < 1;
      EXPECT_LE(corners(4 * i + k, 0), is_inside ? 2.0 : 2.5);
    }
  }
}

TEST(CornerValues, DoNotCrossSurfacesOrCreases) {
  PatchMesh mesh;
  const Vec3 edge = Vec3::UnitX();
  add_welded_quads(mesh, Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY(), 4, 0);
  add_welded_quads(mesh, edge, Vec3::UnitX(), Vec3::UnitY(), 4, 1);  // coplanar, another surface
  add_welded_quads(mesh, Vec3::UnitY(), Vec3::UnitX(), Vec3::UnitZ(), 4,
                   0);  // same surface, a crease
  Eigen::MatrixXd values(mesh.size(), 1);
  values << Eigen::VectorXd::Constant(16, 1), Eigen::VectorXd::Constant(16, 10),
      Eigen::VectorXd::Constant(16, 100);
  const Eigen::MatrixXd corners = corner_values(mesh, values);
  for (Index i = 0; i < mesh.size(); ++i) {
    EXPECT_TRUE((corners.middleRows(4 * i, 4).array() == values(i, 0)).all()) << "patch " << i;
  }
}

TEST(CornerValues, JoinPatchesAcrossASlightBend) {
  PatchMesh mesh;
  add_welded_quads(mesh, Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY(), 1);
  add_welded_quads(mesh, Vec3::UnitX(), Vec3(1, 0, 0.2), Vec3::UnitY(), 1);
  Eigen::MatrixXd values(2, 1);
  values << 1, 1.2;
  const Eigen::MatrixXd smooth = corner_values(mesh, values, 0.35);
  EXPECT_EQ(smooth(1, 0), smooth(4, 0));
  EXPECT_GT(smooth(1, 0), 1);
  EXPECT_LT(smooth(1, 0), 1.2);
  const Eigen::MatrixXd creased = corner_values(mesh, values, 0.1);
  EXPECT_EQ(creased(1, 0), 1);
  EXPECT_EQ(creased(4, 0), 1.2);
}

TEST(CornerValues, GiveTVerticesTheirEdgesValue) {
  PatchMesh mesh;
  add_welded_quads(mesh, Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY(), 1);   // one big patch
  add_welded_quads(mesh, Vec3::UnitX(), Vec3::UnitX(), Vec3::UnitY(), 3);  // and nine small ones
  const Eigen::MatrixXd values =
      values_at_centroids(mesh, [](const Vec3& x) { return 1 + x[0] * x[0] + x[1] * x[1]; });
  const Eigen::MatrixXd corners = corner_values(mesh, values);
  const double low = corners(1, 0);
  const double high = corners(2, 0);
  EXPECT_NE(low, high);
  int n_on_edge = 0;
  for (Index i = 1; i < mesh.size(); ++i) {
    for (int k = 0; k < 4; ++k) {
      const Vec3& x = mesh.corner(i, k);
      if (x[0] != 1) continue;
      ++n_on_edge;
      EXPECT_NEAR(corners(4 * i + k, 0), low + x[1] * (high - low), 1e-14);
    }
  }
  EXPECT_EQ(n_on_edge, 6);
}

TEST(CornerValues, ResolveAPinwheelOfTVertices) {
  // Four rectangles around a square; each inner corner lies on the edge of the next rectangle.
  PatchMesh mesh;
  const Vec3 x = Vec3::UnitX();
  const Vec3 y = Vec3::UnitY();
  add_welded_quads(mesh, Vec3(0, 0, 0), 2 * x, y, 1);
  add_welded_quads(mesh, Vec3(2, 0, 0), x, 2 * y, 1);
  add_welded_quads(mesh, Vec3(1, 2, 0), 2 * x, y, 1);
  add_welded_quads(mesh, Vec3(0, 1, 0), x, 2 * y, 1);
  add_welded_quads(mesh, Vec3(1, 1, 0), x, y, 1);
  Eigen::MatrixXd values(5, 1);
  values << 1, 2, 3, 4, 9;
  const Eigen::MatrixXd corners = corner_values(mesh, values);
  const auto at = [&](Index patch, int k) { return corners(4 * patch + k, 0); };
  // Corner (2, 1) of the first rectangle and the square, on the second's left edge, and so on.
  EXPECT_NEAR(at(0, 2), (at(1, 0) + at(1, 3)) / 2, 1e-13);
  EXPECT_EQ(at(0, 2), at(4, 1));
  EXPECT_NEAR(at(1, 3), (at(2, 0) + at(2, 1)) / 2, 1e-13);
  EXPECT_NEAR(at(2, 0), (at(3, 1) + at(3, 2)) / 2, 1e-13);
  EXPECT_NEAR(at(3, 1), (at(0, 3) + at(0, 2)) / 2, 1e-13);
}

TEST(CornerValues, RepeatTheThirdCornerOfATriangle) {
  const PatchMesh mesh = make_irregular_square();
  const Eigen::MatrixXd corners =
      corner_values(mesh, values_at_centroids(mesh, [](const Vec3& x) { return 1 + x[0]; }));
  ASSERT_EQ(mesh.n_corners(0), 3);
  EXPECT_EQ(corners(3, 0), corners(2, 0));
}

// Inside a closed box of equal radiosity each ray must bring the same value: no ray may slip
// through a crack, and no interpolation may leave the constant.
TEST(Render, ShowsAFurnaceAsOneColor) {
  const PatchMesh mesh = make_room(Vec3(3, 2.5, 7), 7);
  const Visibility visibility(mesh);
  Eigen::MatrixXd radiosity(mesh.size(), 2);
  radiosity.col(0).setConstant(0.3);
  radiosity.col(1).setConstant(700);
  for (const Vec3& direction : {Vec3(0, 0, 1), Vec3(1, 0.3, -0.2), Vec3(-0.577, -0.6, 0.57)}) {
    const Camera camera = {.position = Vec3(1.1, 1.3, 1.7),
                           .direction = direction.normalized(),
                           .up = Vec3(0, 1, 0),
                           .vertical_fov = 2};
    const Image image =
        render(mesh, visibility, radiosity, camera, {.width = 120, .height = 90, .samples = 4});
    ASSERT_EQ(image.values.rows(), 120 * 90);
    EXPECT_TRUE((image.values.col(0).array() == static_cast<float>(0.3 / kPi)).all());
    EXPECT_TRUE((image.values.col(1).array() == static_cast<float>(700 / kPi)).all());
    EXPECT_TRUE(
        std::all_of(image.alpha.begin(), image.alpha.end(), [](float a) { return a == 1; }));
  }
}

TEST(Render, LooksThroughBacksIntoAClosedRoom) {
  constexpr int kSize = 60;
  const PatchMesh mesh = make_room(Vec3(1, 1, 1), 3);
  const Visibility visibility(mesh);
  const Eigen::MatrixXd radiosity = Eigen::MatrixXd::Constant(mesh.size(), 1, kPi);
  const Image image = render(mesh, visibility, radiosity, fit_camera(mesh),
                             {.width = kSize, .height = kSize, .samples = 4});
  const Index n_covered = std::count(image.alpha.begin(), image.alpha.end(), 1.0F);
  EXPECT_GT(n_covered, kSize * kSize / 4);
  EXPECT_LT(n_covered, kSize * kSize);
  for (Index i = 0; i < image.values.rows(); ++i) {
    EXPECT_NEAR(image.values(i, 0), image.alpha[i], 1e-6F) << "pixel " << i;
  }
  // The whole box is inside the picture.
  for (int k = 0; k < kSize; ++k) {
    for (const int pixel : {k, (kSize - 1) * kSize + k, kSize * k, kSize * k + kSize - 1})
      EXPECT_EQ(image.alpha[pixel], 0);
  }
}

TEST(Render, DrawsTheTwinThatFacesTheCamera) {
  PatchMesh mesh;
  mesh.vertices = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  mesh.surface_names = {"sheet"};
  mesh.surface_two_sided = {true};
  mesh.add_patch({0, 1, 2, 3}, 0, 0, 1);
  mesh.add_patch({3, 2, 1, 0}, 0, 0, 0);
  const Visibility visibility(mesh);
  Eigen::MatrixXd radiosity(2, 1);
  radiosity << kPi, 2 * kPi;
  const RenderOptions options = {.width = 4, .height = 4, .samples = 4};
  Camera camera = {.position = Vec3(0, 0, 2), .direction = Vec3(0, 0, -1)};
  EXPECT_TRUE((render(mesh, visibility, radiosity, camera, options).values.array() == 1).all());
  camera.position = Vec3(0, 0, -2);
  camera.direction = Vec3(0, 0, 1);
  EXPECT_TRUE((render(mesh, visibility, radiosity, camera, options).values.array() == 2).all());
}

// A linear field on a wall seen head-on: pixel centres lie at known points of the wall.
TEST(Render, PutsPixelsWhereTheCameraSeesThem) {
  PatchMesh mesh;
  add_welded_quads(mesh, Vec3(-2, -2, 0), Vec3(4, 0, 0), Vec3(0, 4, 0), 8);
  const Visibility visibility(mesh);
  const auto field = [](const Vec3& x) { return 10 + x[0] + 2 * x[1]; };
  const Eigen::MatrixXd radiosity = kPi * values_at_centroids(mesh, field);
  constexpr double kDistance = 2;
  const Camera camera = {.position = Vec3(0, 0, kDistance), .vertical_fov = 2 * std::atan(0.5)};
  const Image image =
      render(mesh, visibility, radiosity, camera, {.width = 6, .height = 4, .samples = 4});
  const double pixel = 2 * kDistance * 0.5 / 4;  // m on the wall, square
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 6; ++x) {
      const Vec3 seen((x - 2.5) * pixel, (1.5 - y) * pixel, 0);
      // Embree's distances are float: about 1e-7 of the scene's size.
      EXPECT_NEAR(image.values(6 * y + x, 0), field(seen), 1e-5) << x << ' ' << y;
    }
  }
}

// The map from a quad's corners to its inside is bilinear: linear fields survive in any planar
// convex quad, whatever its shape.
TEST(Render, InterpolatesLinearFieldsInSkewQuadsAndTriangles) {
  const PatchMesh mesh = make_irregular_square();
  const Visibility visibility(mesh);
  const auto field = [](const Vec3& x) { return 5 + 2 * x[0] - x[1]; };
  const Eigen::MatrixXd radiosity = kPi * values_at_centroids(mesh, field);
  const Camera camera = {.position = Vec3(0.5, 0.5, 1), .vertical_fov = 2 * std::atan(0.45)};
  constexpr int kSize = 64;
  const Image image =
      render(mesh, visibility, radiosity, camera, {.width = kSize, .height = kSize, .samples = 1});
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      const Vec3 seen(0.05 + 0.9 * (x + 0.5) / kSize, 0.95 - 0.9 * (y + 0.5) / kSize, 0);
      EXPECT_NEAR(image.values(kSize * y + x, 0), field(seen), 1e-5) << x << ' ' << y;
    }
  }
}

TEST(Render, DoesNotDependOnTheNumberOfThreads) {
  const PatchMesh mesh = make_room(Vec3(1, 2, 3), 5);
  const Visibility visibility(mesh);
  const Eigen::MatrixXd radiosity =
      values_at_centroids(mesh, [](const Vec3& x) { return 1 + x[0] * x[1] + std::cos(x[2]); });
  const auto picture = [&](std::size_t n_threads) {
    const ThreadLimit limit(n_threads);
    return render(mesh, visibility, radiosity, fit_camera(mesh), {.width = 50, .height = 40})
        .values;
  };
  EXPECT_TRUE((picture(1).array() == picture(4).array()).all());
}

TEST(Render, ReportsRowsAndStopsWhenAsked) {
  const PatchMesh mesh = make_room(Vec3(1, 1, 1), 1);
  const Visibility visibility(mesh);
  const Eigen::MatrixXd radiosity = Eigen::MatrixXd::Ones(mesh.size(), 1);
  double last = 0;
  RenderOptions options = {.width = 8, .height = 20, .samples = 1};
  options.progress.report = [&](std::string_view stage, double done, double total,
                                std::string_view unit) {
    EXPECT_EQ(stage, "picture");
    EXPECT_EQ(unit, "rows");
    EXPECT_EQ(total, 20);
    EXPECT_EQ(done, last + 1);
    last = done;
  };
  render(mesh, visibility, radiosity, fit_camera(mesh), options);
  EXPECT_EQ(last, 20);

  std::stop_source stop;
  stop.request_stop();
  options.progress.stop = stop.get_token();
  EXPECT_THROW(render(mesh, visibility, radiosity, fit_camera(mesh), options), Interrupted);
}

}  // namespace
}  // namespace radiosity
