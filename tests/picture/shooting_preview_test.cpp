#include "radiosity/picture/shooting_preview.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stop_token>
#include <string>
#include <vector>

#include "io/scene/scene_file.h"
#include "meshing/patches/patches.h"
#include "radiosity/base/parallel.h"
#include "radiosity/compressed/make_transport.h"
#include "radiosity/polygon/point_to_polygon.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/scene/radiometry.h"
#include "radiosity/solve/solve.h"
#include "radiosity/visibility/visibility.h"
#include "tests/support/direct_solve.h"
#include "tests/support/shapes.h"

namespace radiosity {
namespace {

using test::energy_norm;
using test::relative_error;

/// A scene of the collection with everything a preview or a solution needs.
struct Room {
  explicit Room(const std::string& name, long n_patches)
      : scene(io::read_scene(RADIOSITY_SCENES "/" + name)),
        mesh(meshing::make_patches(scene, {.n_patches = n_patches})),
        visibility(mesh),
        emitted(exitance(scene, mesh)),
        rho(reflectance(scene, mesh)),
        area(Eigen::VectorXd::Map(mesh.area.data(), mesh.size())) {}

  [[nodiscard]] ShootingPreview preview() const { return {mesh, visibility, emitted, rho}; }
  [[nodiscard]] double power(const Eigen::MatrixXd& b) const {
    return (area.transpose() * b).sum();
  }

  Scene scene;
  PatchMesh mesh;
  Visibility visibility;
  Eigen::MatrixXd emitted;
  Eigen::MatrixXd rho;
  Eigen::VectorXd area;
};

void shoot_until(ShootingPreview& preview, double unshot_share) {
  while (preview.unshot_share() > unshot_share) {
    ASSERT_LT(preview.n_shots(), 100000);
    preview.shoot();
  }
}

PatchMesh cube(int n) {
  PatchMesh mesh;
  test::add_box(mesh, {0, 0, 0}, {1, 1, 1}, n, test::Facing::inwards);
  return mesh;
}

class Previewed : public ::testing::TestWithParam<const char*> {
 protected:
  Room room_{GetParam(), 800};
};

INSTANTIATE_TEST_SUITE_P(ShootingPreview, Previewed,
                         ::testing::Values("cornell-box.json", "l-room.json"));

TEST_P(Previewed, LightIsAboutTheSolution) {
  // A part four of its radii away is up to 4 % too bright. Shades are up to 1/8 off at the borders
  // of shadows, on less than a tenth of the area: sqrt(0.1) / 8 of the whole.
  const double factors = std::hypot(0.04, std::sqrt(0.1) / 8);
  const auto transport = make_transport(room_.mesh, room_.visibility, {.tolerance = 0.02});
  const Eigen::MatrixXd b =
      solve(*transport, room_.emitted, room_.rho, {.tolerance = 1e-4, .on_step = {}}).radiosity;
  const double largest = room_.rho.maxCoeff();
  ShootingPreview preview = room_.preview();
  for (const double share : {0.2, 0.05, 0.001}) {
    shoot_until(preview, share);
    EXPECT_LE(preview.unshot_share(), share);
    for (Index c = 0; c < b.cols(); ++c) {
      const Eigen::VectorXd reflected = b.col(c) - room_.emitted.col(c);
      // The unshot light would become (I - ρ F)^-1 ρ F U.
      const double missing =
          largest / (1 - largest) * energy_norm(room_.area, preview.unshot().col(c));
      const Eigen::VectorXd error = preview.radiosity().col(c) - b.col(c);
      EXPECT_LE(energy_norm(room_.area, error),
                factors * energy_norm(room_.area, reflected) + missing)
          << share << " unshot, column " << c;
    }
  }
}

TEST_P(Previewed, LightNeverExceedsWhatIsEmitted) {
  ShootingPreview preview = room_.preview();
  const double emitted = room_.power(room_.emitted);
  const Eigen::MatrixXd absorptance = 1 - room_.rho.array();
  EXPECT_EQ(preview.radiosity(), room_.emitted);
  EXPECT_EQ(preview.unshot_share(), 1);
  for (int shot = 1; shot <= 200; ++shot) {
    const Eigen::MatrixXd before = preview.radiosity();
    const double unshot_before = preview.unshot_share();
    preview.shoot();
    EXPECT_EQ(preview.n_shots(), shot);
    EXPECT_GE((preview.radiosity() - before).minCoeff(), 0);
    EXPECT_GE(preview.unshot().minCoeff(), 0);
    EXPECT_LT(preview.unshot_share(), unshot_before);
    // What walls have absorbed follows from ρ H = B - M where ρ > 0.
    const Eigen::MatrixXd absorbed =
        (room_.rho.array() > 0)
            .select((preview.radiosity() - room_.emitted).cwiseQuotient(room_.rho), 0)
            .cwiseProduct(absorptance);
    EXPECT_LE(room_.power(absorbed) + room_.power(preview.unshot()), emitted * (1 + 1e-12));
  }
}

TEST_P(Previewed, LightIsTheSameWithAnyNumberOfThreads) {
  ShootingPreview threads = room_.preview();
  ShootingPreview alone = room_.preview();
  for (int shot = 0; shot < 20; ++shot) threads.shoot();
  const ThreadLimit limit(1);
  for (int shot = 0; shot < 20; ++shot) alone.shoot();
  EXPECT_EQ(threads.radiosity(), alone.radiosity());
  EXPECT_EQ(threads.unshot(), alone.unshot());
}

TEST_P(Previewed, LightIsNearerTheSolutionWithTheGuess) {
  const auto transport = make_transport(room_.mesh, room_.visibility, {.tolerance = 0.1});
  const Eigen::MatrixXd b =
      solve(*transport, room_.emitted, room_.rho, {.tolerance = 1e-3, .on_step = {}}).radiosity;
  ShootingPreview preview = room_.preview();
  shoot_until(preview, 0.2);
  EXPECT_LT(relative_error(room_.area, preview.with_ambient(), b),
            relative_error(room_.area, preview.radiosity(), b));
}

TEST(ShootingPreview, GuessIsExactInAFurnace) {
  const PatchMesh mesh = cube(3);
  const Visibility visibility(mesh);
  const Eigen::MatrixXd emitted = Eigen::MatrixXd::Constant(mesh.size(), 1, 2);
  const ShootingPreview preview(mesh, visibility, emitted,
                                Eigen::MatrixXd::Constant(mesh.size(), 1, 0.75));
  EXPECT_LE((preview.with_ambient().array() - 8).abs().maxCoeff(), 1e-12);

  const ShootingPreview white(mesh, visibility, emitted, Eigen::MatrixXd::Ones(mesh.size(), 1));
  EXPECT_EQ(white.with_ambient(), white.radiosity());
}

TEST(ShootingPreview, FewPatchesShootLambertsFactors) {
  const PatchMesh mesh = cube(2);
  const Visibility visibility(mesh);
  Eigen::MatrixXd emitted = Eigen::MatrixXd::Zero(mesh.size(), 2);
  emitted.row(5) << 3, 1;
  ShootingPreview preview(mesh, visibility, emitted,
                          Eigen::MatrixXd::Constant(mesh.size(), 2, 0.5));
  preview.shoot();
  const std::vector<Vec3> source = {mesh.corner(5, 0), mesh.corner(5, 1), mesh.corner(5, 2),
                                    mesh.corner(5, 3)};
  // Nothing is four radii away from half a wall's edge in a cube.
  for (Index i = 0; i < mesh.size(); ++i) {
    if (i == 5) continue;
    const double factor = point_to_polygon(mesh.centroid[i], mesh.normal[i], source);
    EXPECT_NEAR(preview.radiosity()(i, 0), 1.5 * factor, 1e-12);
    EXPECT_NEAR(preview.radiosity()(i, 1), 0.5 * factor, 1e-12);
  }
}

TEST(ShootingPreview, WallsHideWhatIsBehindThem) {
  PatchMesh mesh;
  const auto light = test::add_grid(mesh, {0, 0, 1}, {0, 1, 0}, {1, 0, 0}, 2, 2);    // down
  const auto wall = test::add_grid(mesh, {-1, -1, .5}, {3, 0, 0}, {0, 3, 0}, 1, 1);  // up
  const auto floor = test::add_grid(mesh, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 3, 3);    // up
  const Visibility visibility(mesh);
  Eigen::MatrixXd emitted(mesh.size(), 1);
  for (Index i = 0; i < mesh.size(); ++i) emitted(i) = mesh.surface[i] == light ? 1 : 0;
  ShootingPreview preview(mesh, visibility, emitted, Eigen::MatrixXd::Ones(mesh.size(), 1));
  for (int shot = 0; shot < 4; ++shot) preview.shoot();
  for (Index i = 0; i < mesh.size(); ++i) {
    const double b = preview.radiosity()(i);
    EXPECT_TRUE(mesh.surface[i] != floor || b == 0);
    EXPECT_TRUE(mesh.surface[i] != wall || b > 0);
  }
}

TEST(ShootingPreview, ShootsAtLeastOnceAndStops) {
  const PatchMesh mesh = cube(2);
  const Visibility visibility(mesh);
  const Eigen::MatrixXd half = Eigen::MatrixXd::Constant(mesh.size(), 1, 0.5);
  ShootingPreview preview(mesh, visibility, half, half);
  std::stop_source stop;
  Progress progress;
  double reported = 0;
  progress.report = [&](std::string_view stage, double done, double total, std::string_view) {
    EXPECT_EQ(stage, "preview");
    EXPECT_EQ(total, 1);
    reported = done;
  };
  progress.stop = stop.get_token();
  preview.shoot(0, progress);
  EXPECT_EQ(preview.n_shots(), 1);
  EXPECT_EQ(reported, 1 - preview.unshot_share());
  stop.request_stop();
  EXPECT_THROW(preview.shoot(10, progress), Interrupted);
  EXPECT_EQ(preview.n_shots(), 1);
}

TEST(ShootingPreview, OfDarknessIsDark) {
  const PatchMesh mesh = cube(2);
  const Visibility visibility(mesh);
  ShootingPreview preview(mesh, visibility, Eigen::MatrixXd::Zero(mesh.size(), 3),
                          Eigen::MatrixXd::Constant(mesh.size(), 3, 0.5));
  preview.shoot(10);
  EXPECT_EQ(preview.n_shots(), 0);
  EXPECT_EQ(preview.unshot_share(), 0);
  EXPECT_EQ(preview.with_ambient().norm(), 0);
}

}  // namespace
}  // namespace radiosity
