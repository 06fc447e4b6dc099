#include "radiosity/scene/symmetry.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "radiosity/assembly/make_dense_transport.h"
#include "radiosity/base/error.h"
#include "radiosity/exchange/cut_off.h"
#include "radiosity/exchange/evaluated_row.h"
#include "radiosity/exchange/point_factors.h"
#include "radiosity/operator/factor_rows.h"
#include "radiosity/scene/whole_mesh.h"
#include "radiosity/solve/solve.h"
#include "radiosity/visibility/visibility.h"
#include "tests/support/shapes.h"
#include "tests/support/symmetric_parts.h"

namespace radiosity {
namespace {

using test::add_grid;
using test::cube_corner;
using test::folds_about_z;
using test::mirror;
using test::part_of;
using test::placed;
using test::Placement;
using test::placements;
using test::prism_sector;
using test::three_mirrors;

/// As evaluated: rows are not closed.
std::unique_ptr<Transport> raw_transport(const PatchMesh& mesh, double tolerance) {
  return make_dense_transport(mesh, Visibility(mesh),
                              {.tolerance = tolerance, .closed = Closed::no});
}

Eigen::MatrixXd factors(const PatchMesh& mesh, double tolerance = 1e-7) {
  const auto transport = raw_transport(mesh, tolerance);
  Eigen::MatrixXd rows(mesh.size(), mesh.size());
  for (Index i = 0; i < mesh.size(); ++i) rows.row(i) = rows_of(*transport).row(i).transpose();
  return rows;
}

/// The part's form factors from those of the whole, as any other scene.
Eigen::MatrixXd folded(const PatchMesh& part, double tolerance = 1e-7) {
  const Eigen::MatrixXd whole = factors(make_whole(part), tolerance);
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(part.size(), part.size());
  for (Index g = 0; g < whole.cols(); g += part.size()) {
    sum += whole.block(0, g, part.size(), part.size());
  }
  return sum;
}

/// Exact pairs: the kernel's error, 1e-11 relative, in sums of up to some hundred entries.
constexpr double kExact = 1e-9;

void expect_symmetric(const PatchMesh& part, const Eigen::MatrixXd& rows) {
  for (Index i = 0; i < part.size(); ++i) {
    for (Index j = 0; j < i; ++j) {
      EXPECT_NEAR(part.area[i] * rows(i, j), part.area[j] * rows(j, i),
                  4e-16 * part.area[i] * rows(i, j));
    }
  }
}

TEST(Symmetry, EighthOfACubeIsTheCube) {
  for (const Placement& placement : placements()) {
    const PatchMesh part = part_of(cube_corner(3), three_mirrors(), placement);
    ASSERT_EQ(part.images.size(), 7U);
    const Eigen::MatrixXd rows = factors(part);
    EXPECT_LT((rows - folded(part)).cwiseAbs().maxCoeff(), kExact);
    EXPECT_LT((rows.rowwise().sum().array() - 1).abs().maxCoeff(), kExact);
    expect_symmetric(part, rows);
  }
}

/// A floor with the edge of a plate above it, lit through the images.
TEST(Symmetry, AFlatPatchSeesItsOwnImage) {
  PatchMesh mesh;
  add_grid(mesh, Vec3(1, 0, 0), Vec3(0, 0, 1), Vec3(0, 1, 0), 1, 1);  // faces x = 0
  const Symmetry symmetry{{mirror(Vec3::UnitX())}, {}, {}};
  for (const Placement& placement : placements()) {
    const PatchMesh part = part_of(mesh, symmetry, placement);
    const Eigen::MatrixXd rows = factors(part);
    // Opposed squares of side 1 at distance 2 (Howell C-11).
    const double x = 0.5;
    const double root = std::sqrt(1 + x * x);
    const double expected = 2 / (kPi * x * x) *
                            (std::log((1 + x * x) / std::sqrt(1 + 2 * x * x)) +
                             2 * x * root * std::atan(x / root) - 2 * x * std::atan(x));
    EXPECT_NEAR(rows(0, 0), expected, kExact);
    const auto transport = make_dense_transport(part, Visibility(part));
    // B = 1 + ρ F B
    const Solution solution = solve(*transport, Eigen::MatrixXd::Constant(1, 1, 1.0),
                                    Eigen::MatrixXd::Constant(1, 1, 0.8), {.tolerance = 1e-12});
    EXPECT_NEAR(solution.radiosity(0, 0), 1 / (1 - 0.8 * expected), 1e-9);
  }
}

/// An eighth of a cube, with a box that hides some of it and its images.
PatchMesh blocked_corner() {
  PatchMesh mesh = cube_corner(2);
  test::add_box(mesh, Vec3(0.1, 0.15, 0.2), Vec3(0.35, 0.5, 0.45), 1, test::Facing::outwards);
  return mesh;
}

/// Each row of the part is that of the whole, images added up, within six standard errors of both
/// and `exact`.
void expect_part_of_whole(const Transport& made, const Transport& all, double exact) {
  const Index n = made.size();
  for (Index i = 0; i < n; ++i) {
    const Eigen::VectorXd row = rows_of(made).row(i);
    const Eigen::VectorXd error = rows_of(made).row_error(i);
    const Eigen::VectorXd of_whole = rows_of(all).row(i);
    const Eigen::VectorXd its_error = rows_of(all).row_error(i);
    for (Index j = 0; j < n; ++j) {
      double expected = 0;
      double sigma = error[j];
      for (Index k = j; k < of_whole.size(); k += n) {
        expected += of_whole[k];
        sigma += its_error[k];
      }
      EXPECT_NEAR(row[j], expected, 6 * sigma + exact) << i << " " << j;
    }
  }
}

TEST(Symmetry, ShadowsCrossTheMirrors) {
  for (const Placement& placement : placements()) {
    const PatchMesh part = part_of(blocked_corner(), three_mirrors(), placement);
    const auto made = raw_transport(part, 1e-3);
    const auto all = raw_transport(make_whole(part), 1e-3);
    expect_part_of_whole(*made, *all, kExact);
  }
}

/// Half of a box that stands on the mirror plane has its other half there.
TEST(Symmetry, BoxesGoOnBeyondTheMirrors) {
  PatchMesh mesh = cube_corner(2);
  add_grid(mesh, Vec3(0.4, 0.3, 0), Vec3(0, 0.3, 0), Vec3(0, 0, 0.5), 1, 1);    // +x, cut by z = 0
  add_grid(mesh, Vec3(0.2, 0.3, 0), Vec3(0, 0, 0.5), Vec3(0, 0.3, 0), 1, 1);    // -x
  add_grid(mesh, Vec3(0.2, 0.6, 0), Vec3(0, 0, 0.5), Vec3(0.2, 0, 0), 1, 1);    // +y
  add_grid(mesh, Vec3(0.2, 0.3, 0), Vec3(0.2, 0, 0), Vec3(0, 0, 0.5), 1, 1);    // -y
  add_grid(mesh, Vec3(0.2, 0.3, 0.5), Vec3(0.2, 0, 0), Vec3(0, 0.3, 0), 1, 1);  // +z
  for (const Placement& placement : placements()) {
    const PatchMesh part = part_of(mesh, three_mirrors(), placement);
    const auto made = raw_transport(part, 1e-3);
    const auto all = raw_transport(make_whole(part), 1e-3);
    for (Index i = 0; i < part.size(); ++i) {
      const Eigen::VectorXd row = rows_of(*made).row(i);
      const Eigen::VectorXd of_whole = rows_of(*all).row(i);
      const double sigma = rows_of(*made).row_error(i).sum();
      // Open to nothing: the box is closed by its images.
      EXPECT_NEAR(row.sum(), 1, 6 * sigma + kExact) << i;
      EXPECT_NEAR(of_whole.sum(), 1, 6 * rows_of(*all).row_error(i).sum() + kExact) << i;
    }
  }
}

TEST(Symmetry, SectorsOfConcentricBodiesAreTheWhole) {
  for (const int folds : {3, 5, 12}) {
    for (const Placement& placement : placements()) {
      const PatchMesh part =
          part_of(prism_sector(folds, 0.4, 1, 0.8), folds_about_z(folds), placement);
      ASSERT_EQ(part.images.size(), static_cast<std::size_t>(folds - 1));
      const auto made = make_dense_transport(part, Visibility(part), {.tolerance = 1e-3});
      const PatchMesh whole = make_whole(part);
      const auto all = make_dense_transport(whole, Visibility(whole), {.tolerance = 1e-3});
      EXPECT_TRUE(made->report().closed) << folds;
      const Eigen::VectorXd sums = made->apply(Eigen::VectorXd::Ones(part.size()));
      EXPECT_LT((sums.array() - 1).abs().maxCoeff(), kExact);
      expect_part_of_whole(*made, *all, kExact);
    }
  }
}

/// Of concentric spheres, and of polyhedra that are each other's images, F21 = A1 / A2 = (r1 /
/// r2)²: all that leaves the inner one meets the outer one, and all those pairs are exact.
TEST(Symmetry, SectorsOfConcentricSpheresAreTheWhole) {
  const double inner = 0.35;
  const double outer = 0.9;
  for (const int folds : {4, 9}) {
    Symmetry symmetry = folds_about_z(folds);
    symmetry.mirrors = {mirror(Vec3::UnitZ())};
    for (const Placement& placement : placements()) {
      const PatchMesh part =
          part_of(test::sphere_sector(folds, 3, inner, outer), symmetry, placement);
      ASSERT_EQ(part.images.size(), static_cast<std::size_t>(2 * folds - 1));
      const auto made = raw_transport(part, 1e-3);
      expect_part_of_whole(*made, *raw_transport(make_whole(part), 1e-3), kExact);
      double returned = 0;
      double area = 0;
      for (Index i = 0; i < part.size(); ++i) {
        const Eigen::VectorXd row = rows_of(*made).row(i);
        if (part.surface[i] == 0) {
          EXPECT_NEAR(row.sum(), 1, kExact);
          continue;
        }
        EXPECT_NEAR(row.sum(), 1, 6 * rows_of(*made).row_error(i).sum() + kExact);
        returned += part.area[i] * row.head(3).sum();
        area += part.area[i];
      }
      EXPECT_NEAR(returned / area, inner * inner / (outer * outer), kExact);
    }
  }
}

/// Of an infinitely long prism in another, without ends: F21 = perimeter ratio, as nothing of the
/// inner one sees itself; here by translation along the axis, off by no more than the bound tells.
TEST(Symmetry, LongConcentricPrismsHaveThePerimetersRatio) {
  const int folds = 6;
  PatchMesh mesh = prism_sector(folds, 0.4, 1, 0.8);
  PatchMesh open;  // without its ends
  open.vertices = mesh.vertices;
  open.surface_names = mesh.surface_names;
  open.surface_two_sided = mesh.surface_two_sided;
  for (Index i = 0; i < 4; ++i) open.add_patch(mesh.corners[i], mesh.surface[i], mesh.polygon[i]);
  double before = 1;
  for (const int n_images : {2, 8}) {
    Symmetry symmetry = folds_about_z(folds);
    symmetry.translations.push_back({Vec3(0, 0, 0.8), n_images});
    for (const Placement& placement : placements()) {
      const PatchMesh part = part_of(open, symmetry, placement);
      const Symmetry here = placed(symmetry, placement);
      const auto made = make_dense_transport(part, Visibility(part), {.tolerance = 1e-4});
      const Eigen::VectorXd bound = cut_off_bound(part, here);
      for (Index i = 0; i < part.size(); ++i) {
        const double lost = 1 - rows_of(*made).row(i).sum();
        const double sigma = rows_of(*made).row_error(i).sum();
        EXPECT_GT(lost, -6 * sigma - kExact);
        EXPECT_LT(lost, bound[i] + 6 * sigma + kExact);
      }
      const Eigen::VectorXd outer = rows_of(*made).row(2);
      EXPECT_NEAR(outer.head(2).sum(), 0.4, bound[2] + 6 * rows_of(*made).row_error(2).sum());
      EXPECT_LT(bound.maxCoeff(), 0.7 * before);
    }
    const PatchMesh part = part_of(open, symmetry, {});
    before = cut_off_bound(part, symmetry).maxCoeff();
  }
}

/// A street between two walls: rows converge to Hottel's crossed strings.
TEST(Symmetry, CanyonByTranslationIsTheLongCanyon) {
  const PatchMesh mesh = test::canyon_period(2, 0.5);
  const Symmetry symmetry{{}, {}, {{Vec3(0, 0.5, 0), 10}}};
  for (const Placement& placement : placements()) {
    const PatchMesh part = part_of(mesh, symmetry, placement);
    ASSERT_EQ(part.images.size(), 20U);
    const Eigen::MatrixXd rows = factors(part);
    EXPECT_LT((rows - folded(part)).cwiseAbs().maxCoeff(), kExact);
    expect_symmetric(part, rows);
    const Eigen::VectorXd bound = cut_off_bound(part, placed(symmetry, placement));
    // Walls of height 1 at distance 1: F = √2 - 1; nothing is between.
    const double across = (rows.row(2).segment(4, 2).sum() + rows.row(3).segment(4, 2).sum()) / 2;
    const double off = (bound[2] + bound[3]) / 2;
    EXPECT_LT(across, std::sqrt(2) - 1);
    EXPECT_GT(across, std::sqrt(2) - 1 - off);
    EXPECT_LT(off, 0.05);
  }
}

TEST(Symmetry, MirrorsAndTurnsTogether) {
  // Half of one of 4 sides of a square room: mirrors make the other half and the ceiling.
  PatchMesh mesh;
  add_grid(mesh, Vec3(1, 0, 0), Vec3(0, 0, 0.5), Vec3(0, 1, 0), 2, 2);
  const auto first = static_cast<std::int32_t>(mesh.vertices.size());
  for (const Vec3& x : {Vec3(0, 0, 0.5), Vec3(1, 1, 0.5), Vec3(1, 0, 0.5)}) {
    mesh.vertices.push_back(x);
  }
  mesh.surface_names.emplace_back("ceiling");
  mesh.surface_two_sided.push_back(false);
  mesh.add_patch({first, first + 1, first + 2, -1}, 1, 1);
  Symmetry symmetry = folds_about_z(4);
  symmetry.mirrors = {mirror(Vec3::UnitY()), mirror(Vec3::UnitZ())};
  Symmetry by_planes{
      {mirror(Vec3::UnitY()), mirror(Vec3(1, -1, 0)), mirror(Vec3::UnitZ())}, {}, {}};
  for (const Placement& placement : placements()) {
    const PatchMesh part = part_of(mesh, symmetry, placement);
    ASSERT_EQ(part.images.size(), 15U);
    const Eigen::MatrixXd rows = factors(part);
    EXPECT_LT((rows - folded(part)).cwiseAbs().maxCoeff(), kExact);
    EXPECT_LT((rows.rowwise().sum().array() - 1).abs().maxCoeff(), kExact);
    expect_symmetric(part, rows);
    const PatchMesh same = part_of(mesh, by_planes, placement);
    ASSERT_EQ(same.images.size(), 15U);
    EXPECT_LT((factors(same) - rows).cwiseAbs().maxCoeff(), kExact);
  }
}

TEST(Symmetry, RowsAloneAreThoseOfAll) {
  const PatchMesh part = part_of(cube_corner(2), three_mirrors(), placements()[1]);
  const Visibility visibility(part);
  const Eigen::MatrixXd rows = factors(part);
  for (std::int32_t i = 0; i < part.size(); ++i) {
    const JointRow row = evaluated_row(part, visibility, {i}, {.tolerance = 1e-7});
    EXPECT_LT((row.factor - rows.row(i).transpose()).cwiseAbs().maxCoeff(), kExact);
  }
  const Destinations all = point_factors(part, part.centroid[0], part.normal[0]);
  EXPECT_NEAR(all.surfaces.sum(), 1, kExact);
  EXPECT_NEAR(all.sky, 0, kExact);
}

/// The light of all images: what all emit in a furnace comes back.
TEST(Symmetry, FurnaceIsEven) {
  for (const Placement& placement : placements()) {
    const PatchMesh part = part_of(blocked_corner(), three_mirrors(), placement);
    const auto transport = make_dense_transport(part, Visibility(part), {.closed = Closed::yes});
    const Eigen::MatrixXd reflectance = Eigen::VectorXd::LinSpaced(part.size(), 0.1, 0.9);
    const Eigen::MatrixXd exitance = (1 - reflectance.array()).matrix();
    const Solution solution = solve(*transport, exitance, reflectance, {.tolerance = 1e-12});
    EXPECT_LT((solution.radiosity.array() - 1).abs().maxCoeff(), 1e-6);
  }
}

TEST(Symmetry, SameBitsAtAnyNumberOfThreads) {
  const PatchMesh part = part_of(blocked_corner(), three_mirrors(), placements()[1]);
  const Eigen::MatrixXd once = factors(part, 1e-2);
  EXPECT_EQ(factors(part, 1e-2), once);
}

std::string error_of(const Symmetry& symmetry) {
  try {
    (void)image_motions(symmetry);
  } catch (const SceneError& error) {
    return error.what();
  }
  return "";
}

TEST(ImageMotions, RefusesWhatHasNoEnd) {
  Symmetry parallel{{mirror(Vec3::UnitX()), {Vec3(1, 0, 0), Vec3::UnitX()}}, {}, {}};
  EXPECT_NE(error_of(parallel).find("without end"), std::string::npos) << error_of(parallel);
  Symmetry oblique{{mirror(Vec3::UnitX()), mirror(Vec3(1, 0.001, 0.3))}, {}, {}};
  EXPECT_NE(error_of(oblique).find("more than 4096"), std::string::npos) << error_of(oblique);
  Symmetry skew{{mirror(Vec3(1, 1, 0))}, {}, {{Vec3(1, 0, 0), 2}}};
  EXPECT_NE(error_of(skew).find("carry the translations"), std::string::npos) << error_of(skew);
  Symmetry along{{}, {}, {{Vec3(1, 0, 0), 2}, {Vec3(2, 0, 0), 2}}};
  EXPECT_NE(error_of(along).find("parallel"), std::string::npos) << error_of(along);
}

TEST(ImageMotions, HaveTheirInverses) {
  std::vector<Symmetry> all{three_mirrors(), folds_about_z(7)};
  all.push_back({{mirror(Vec3(1, 1, 0)), mirror(Vec3(1, -1, 0))},
                 {},
                 {{Vec3(2, 0, 0), 2}, {Vec3(0, 2, 0), 2}}});
  for (const Symmetry& symmetry : all) {
    for (const Placement& placement : placements()) {
      const std::vector<Motion> motions = image_motions(placed(symmetry, placement));
      for (const Motion& motion : motions) {
        int n = 0;
        for (const Motion& other : motions) {
          const Motion both = after(other, motion);
          n += both.linear.isIdentity(1e-12) && both.shift.norm() < 1e-10 ? 1 : 0;
        }
        EXPECT_EQ(n, 1);
      }
    }
  }
}

}  // namespace
}  // namespace radiosity
