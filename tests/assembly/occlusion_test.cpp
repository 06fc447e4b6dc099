/// What partly hidden pairs must obey: closure without a correction, standard errors that hold, and
/// proofs that are never wrong.

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <random>

#include "io/scene/scene_file.h"
#include "meshing/patches/patches.h"
#include "radiosity/assembly/make_dense_transport.h"
#include "radiosity/assembly/transport_options.h"
#include "radiosity/base/parallel.h"
#include "radiosity/exchange/pair_kernel.h"
#include "radiosity/exchange/visible_fraction.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/visibility/visibility.h"
#include "tests/support/shapes.h"

namespace {

using namespace radiosity;
using test::box_in_box;

TEST(BoxInBox, ClosesWithoutCorrection) {
  const PatchMesh mesh = box_in_box(6, 3);
  const Visibility visibility(mesh);
  for (const double tolerance : {1e-2, 1e-3, 1e-5}) {
    const auto transport =
        make_dense_transport(mesh, visibility, {.tolerance = tolerance, .closed = Closed::no});
    EXPECT_LE(transport->report().closure_max, tolerance);
    EXPECT_FALSE(transport->report().closed);
    const auto closed = make_dense_transport(mesh, visibility, {.tolerance = tolerance});
    EXPECT_TRUE(closed->report().closed);
    EXPECT_EQ(closed->report().open_rows, 0);
    const Eigen::VectorXd sums = closed->apply(Eigen::VectorXd::Ones(mesh.size()));
    EXPECT_LE((sums.array() - 1).abs().maxCoeff(), 1e-10);
  }
}

TEST(BoxInBox, ErrorsHoldAndSumUpToTheTolerance) {
  constexpr double kTolerance = 1e-3;
  const PatchMesh mesh = box_in_box(6, 3);
  const Visibility visibility(mesh);
  const auto transport =
      make_dense_transport(mesh, visibility, {.tolerance = kTolerance, .closed = Closed::no});
  const auto reference =
      make_dense_transport(mesh, visibility, {.tolerance = 1e-7, .closed = Closed::no});
  double difference = 0;
  double errors = 0;
  double sum = 0;
  double n_uncertain = 0;
  int within_one = 0;
  int within_two = 0;
  for (Index i = 0; i < mesh.size(); ++i) {
    const Eigen::ArrayXd row = rows_of(*transport).row(i);
    const Eigen::ArrayXd truth = rows_of(*reference).row(i);
    const Eigen::ArrayXd error = rows_of(*transport).row_error(i);
    difference += mesh.area[i] * (row - truth).abs().sum();
    errors += mesh.area[i] * error.sum();
    sum += mesh.area[i] * truth.sum();
    for (Index j = 0; j < mesh.size(); ++j) {
      if (error[j] == 0) {
        EXPECT_NEAR(row[j], truth[j], 1e-6 * truth[j]);  // proved, but for the kernel's rule
        continue;
      }
      ++n_uncertain;
      within_one += std::abs(row[j] - truth[j]) <= error[j] ? 1 : 0;
      within_two += std::abs(row[j] - truth[j]) <= 2 * error[j] ? 1 : 0;
    }
  }
  // The mean of |x| is less than the standard error of x, and so many entries leave nothing to
  // chance; all that errors tell together is within what was asked.
  EXPECT_LE(difference, errors + 1e-6 * sum);
  EXPECT_LE(errors, kTolerance * sum);
  EXPECT_GT(n_uncertain, 1000);
  // What the constants of the rules were set to, less four standard errors of so many entries, of
  // which (i, j) and (j, i) are one.
  const auto least = [&](double share) {
    return n_uncertain * (share - 4 * std::sqrt(share * (1 - share) / (n_uncertain / 2)));
  };
  EXPECT_GE(within_one, least(0.90));
  EXPECT_GE(within_two, least(0.95));
}

/// Whether the segment passes through the inside of a patch other than its ends', by more than
/// `margin` (relative to the patch) from its border: in double precision, all patches one by one.
bool is_blocked_surely(const PatchMesh& mesh, const Vec3& from, const Vec3& to, Index i, Index j,
                       double margin) {
  for (Index k = 0; k < mesh.size(); ++k) {
    if (k == i || k == j) continue;
    const double height_from = mesh.normal[k].dot(from - mesh.centroid[k]);
    const double height_to = mesh.normal[k].dot(to - mesh.centroid[k]);
    const double size = std::sqrt(mesh.area[k]);
    if (height_from * height_to >= 0) continue;
    if (std::min(std::abs(height_from), std::abs(height_to)) < margin * size) continue;
    const Vec3 point = from + height_from / (height_from - height_to) * (to - from);
    bool is_inside = true;
    for (int c = 0; c < mesh.n_corners(k); ++c) {
      const Vec3& corner = mesh.corner(k, c);
      const Vec3 edge = mesh.corner(k, (c + 1) % mesh.n_corners(k)) - corner;
      is_inside &= mesh.normal[k].dot(edge.cross(point - corner)) > margin * size * edge.norm();
    }
    if (is_inside) return true;
  }
  return false;
}

/// Pairs that were proved visible or hidden, a random million of them: rays must not disagree. A
/// ray that does is checked in double precision, since Embree may miss or hit where it grazes an
/// edge.
TEST(Certificates, AreNeverWrong) {
  constexpr std::uint64_t kSeed = 7;
  constexpr int kPairs = 1000000;
  constexpr double kMargin = 1e-4;
  const PatchMesh mesh = meshing::make_patches(io::read_scene(RADIOSITY_SCENES "/cornell-box.json"),
                                               {.n_patches = 4608});
  const Visibility visibility(mesh);
  const auto transport =
      make_dense_transport(mesh, visibility, {.tolerance = 1e-2, .closed = Closed::no});
  const PreparedMesh prepared(mesh);
  const PairKernel kernel(prepared, 1e-6);
  const Vec3 center = bounds(mesh).center();
  std::mt19937_64 random(kSeed);
  std::vector<Index> rows(mesh.size());
  for (Index i = 0; i < mesh.size(); ++i) rows[i] = i;
  std::shuffle(rows.begin(), rows.end(), random);
  int n_checked = 0;
  std::atomic<int> n_visible = 0;
  std::atomic<int> n_hidden = 0;
  std::atomic<int> n_wrong = 0;
  for (std::size_t first = 0; first < rows.size() && n_checked < kPairs; ++first) {
    const Index i = rows[first];
    const Eigen::VectorXd row = rows_of(*transport).row(i);
    const Eigen::VectorXd error = rows_of(*transport).row_error(i);
    std::vector<Index> partners;
    for (Index j = 0; j < mesh.size(); ++j) {
      const bool is_facing =
          kernel.in_front(i, j) == Blocking::all && kernel.in_front(j, i) == Blocking::all;
      if (i != j && is_facing && error[j] == 0) partners.push_back(j);
    }
    n_checked += static_cast<int>(partners.size());
    parallel_for(static_cast<std::ptrdiff_t>(partners.size()), [&](std::ptrdiff_t k) {
      const Index j = partners[k];
      const bool is_visible = row[j] > 0;
      (is_visible ? n_visible : n_hidden) += 1;
      const auto a = static_cast<std::int32_t>(i);
      const auto b = static_cast<std::int32_t>(j);
      const SampledPair pair{
          prepared.polygons[i], prepared.planes[i], prepared.polygons[j], prepared.planes[j], a, b};
      const SegmentPacket packet = SegmentSampler(pair, pair_seed(kSeed, a, b)).next().segments;
      const std::uint32_t blocked = visibility.blocked(packet, a, b);
      const auto point = [&](const auto& lanes, int ray) {
        return Vec3(center + Vec3(lanes[0][ray], lanes[1][ray], lanes[2][ray]));
      };
      for (int ray = 0; ray < Visibility::kPacket; ++ray) {
        const bool is_blocked = (blocked >> ray & 1U) != 0;
        if (is_blocked != is_visible) continue;
        // A hidden pair's free ray must graze something, a visible pair's blocked ray, too.
        const bool is_surely =
            is_blocked_surely(mesh, point(packet.from, ray), point(packet.to, ray), i, j,
                              is_visible ? kMargin : -kMargin);
        if (is_surely == is_visible) ++n_wrong;
      }
    });
  }
  EXPECT_GE(n_checked, kPairs);
  EXPECT_GT(n_visible, kPairs / 2);
  EXPECT_GT(n_hidden, kPairs / 20);
  EXPECT_EQ(n_wrong, 0) << "seed " << kSeed;
}

}  // namespace
