#include "tests/support/family_checks.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <random>
#include <sstream>

#include "meshing/patches/patches.h"
#include "radiosity/assembly/transport_options.h"
#include "radiosity/base/error.h"
#include "radiosity/compressed/make_transport.h"
#include "radiosity/exchange/openings.h"
#include "radiosity/operator/surface_factors.h"
#include "radiosity/operator/transport.h"
#include "radiosity/polygon/exchange_area.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/visibility/blocker.h"
#include "radiosity/visibility/cluster_tree.h"
#include "radiosity/visibility/cluster_visibility.h"
#include "radiosity/visibility/visibility.h"
#include "tests/support/oracle.h"

namespace radiosity::test {
namespace {

/// Relative difference of an entry from its unobstructed value that its kernel explains.
constexpr double kKernelError = 1e-5;
/// The same of patches that touch each other with edges that are off by a share of their widths,
/// relative to that share, and where they are too narrow for their digits.
constexpr double kDigitsError = 50;
constexpr double kMostDigitsError = 1e-2;
/// Above this share the digits may leave open what a solid covers of a patch.
constexpr double kMostSliver = 1e-4;
/// Form factors below this are too near to edge-on to be called certified either way.
constexpr double kLeastFactor = 1e-9;
constexpr double kSigmas = 5;
/// Factors that differ are looked at again with so many times the rays: of millions of comparisons
/// some are beyond five sigma by chance.
constexpr int kMoreRays = 20;
constexpr std::size_t kMostFailures = 2;  // per scene and kind

std::string number(double value) {
  std::ostringstream text;
  text.precision(8);
  text << value;
  return text.str();
}

std::string vector_text(const Vec3& v) {
  std::ostringstream text;
  text.precision(10);
  text << '(' << v.x() << ", " << v.y() << ", " << v.z() << ')';
  return text.str();
}

class SceneCheck {
 public:
  SceneCheck(const FamilyScene& family_scene, const CheckOptions& options, PatchMesh mesh)
      : family_scene_(family_scene),
        options_(options),
        mesh_(std::move(mesh)),
        oracle_(family_scene, mesh_),
        visibility_(mesh_),
        random_(options.seed) {}

  Findings run() {
    found_.n_scenes = 1;
    found_.n_patches = mesh_.size();
    // The correction of closed scenes leaves certified entries as they are.
    const auto transport =
        make_transport(mesh_, visibility_,
                       {.tolerance = options_.tolerance,
                        .closed = family_scene_.is_closed ? Closed::automatic : Closed::no});
    check_pairs(*transport);
    check_clusters();
    check_factors(*transport);
    if (family_scene_.is_closed) check_closure(*transport);
    return std::move(found_);
  }

 private:
  void fail(const std::string& kind, const std::string& what) {
    const auto n = std::count_if(found_.failures.begin(), found_.failures.end(),
                                 [&](const std::string& f) { return f.starts_with(kind); });
    if (static_cast<std::size_t>(n) >= kMostFailures) return;
    found_.failures.push_back(kind + ": " + what + " [" + family_scene_.name + ", " +
                              std::to_string(mesh_.size()) + " patches]");
  }

  [[nodiscard]] std::string name(Index patch) const {
    return std::to_string(patch) + " of " + mesh_.surface_names[mesh_.surface[patch]] + " " +
           vector_text(mesh_.centroid[patch]);
  }

  [[nodiscard]] std::vector<Vec3> outline(Index patch) const {
    std::vector<Vec3> points;
    for (int k = 0; k < mesh_.n_corners(patch); ++k) {
      points.push_back(mesh_.corner(patch, k) - oracle_.center());
    }
    return points;
  }

  /// A segment between two patches as the oracle sees it.
  struct Segment {
    Vec3 from;
    Vec3 to;
    bool faces = false;  ///< the ends are in front of each other's patch
    bool is_free = false;
    bool is_blocked = false;  ///< or covered at an end
    bool is_crossed = false;  ///< blocked between ends that are not covered
  };
  Segment random_segment(Index i, Index j) {
    Segment s{oracle_.random_point(i, random_), oracle_.random_point(j, random_)};
    s.faces = oracle_.height(i, s.to) > 0 && oracle_.height(j, s.from) > 0;
    if (!s.faces) return s;
    const Sight sight = oracle_.sight(i, s.from, j, s.to);
    const Cover cover_from = oracle_.cover(i, s.from);
    const Cover cover_to = oracle_.cover(j, s.to);
    s.is_free = sight == Sight::free && cover_from == Cover::no && cover_to == Cover::no;
    s.is_crossed = sight == Sight::blocked && cover_from == Cover::no && cover_to == Cover::no;
    s.is_blocked = sight == Sight::blocked || cover_from == Cover::yes || cover_to == Cover::yes;
    return s;
  }

  void check_pairs(const Transport& transport) {
    std::vector<Index> rows(mesh_.size());
    std::iota(rows.begin(), rows.end(), 0);
    std::shuffle(rows.begin(), rows.end(), random_);
    for (const Index i : rows) {
      if (found_.n_visible + found_.n_hidden >= options_.n_pairs) break;
      const Eigen::VectorXd row = rows_of(transport).row(i);
      const Eigen::VectorXd error = rows_of(transport).row_error(i);
      const std::vector<Vec3> outline_i = outline(i);
      for (Index j = 0; j < mesh_.size(); ++j) {
        if (j != i && error[j] == 0) check_pair(i, j, row[j], outline_i);
      }
    }
  }

  /// Width of a patch across its longest edge, m.
  [[nodiscard]] double width(Index patch) const {
    double longest = 0;
    const int n = mesh_.n_corners(patch);
    for (int k = 0; k < n; ++k) {
      longest =
          std::max(longest, (mesh_.corner(patch, (k + 1) % n) - mesh_.corner(patch, k)).norm());
    }
    return mesh_.area[patch] / longest;
  }

  /// Whether some of patch j is in front of patch i, beyond what digits leave open.
  [[nodiscard]] bool is_in_front(Index i, Index j) const {
    for (int k = 0; k < mesh_.n_corners(j); ++k) {
      if (oracle_.height(i, mesh_.corner(j, k) - oracle_.center()) > 0) return true;
    }
    return false;
  }

  /// Whether some of patch j is behind patch i.
  [[nodiscard]] bool crosses_plane(Index i, Index j) const {
    for (int k = 0; k < mesh_.n_corners(j); ++k) {
      const double h = mesh_.normal[i].dot(mesh_.corner(j, k) - mesh_.centroid[i]);
      if (h < -kLeastFactor * mesh_.area[i] / width(i)) return true;
    }
    return false;
  }

  void check_pair(Index i, Index j, double factor, const std::vector<Vec3>& outline_i) {
    if (!is_in_front(i, j) || !is_in_front(j, i)) return;
    // Of patches that cross each other's planes only the exact value is reliable.
    const bool is_cut = crosses_plane(i, j) || crosses_plane(j, i);
    const double tolerance = is_cut ? 1e-11 : kKernelError / 100;
    const double whole = exchange_area(outline_i, outline(j), tolerance) / mesh_.area[i];
    if (whole < kLeastFactor) return;
    // Patches that touch move relative to each other by what the digits leave open.
    const double digits = kDigitsError * oracle_.thickness() / std::min(width(i), width(j));
    if (digits > kMostDigitsError) return;
    const double allowed = kKernelError + digits;
    if (factor > whole * (1 + allowed) + kLeastFactor) {
      ++found_.n_wrong_values;
      fail("value", "F " + number(factor) + " above " + number(whole) + " from " + name(i) +
                        " to " + name(j));
    }
    // What is cut exactly is certified, too, but as partly hidden.
    const bool is_visible = factor >= whole * (1 - kKernelError);
    if (!is_visible && factor > 0) return;
    ++(is_visible ? found_.n_visible : found_.n_hidden);
    for (int k = 0; k < options_.n_segments; ++k) {
      const Segment s = random_segment(i, j);
      // A sliver of cover may be less than the digits leave open.
      const bool is_shut = allowed > kMostSliver ? s.is_crossed : s.is_blocked;
      if (!(is_visible ? is_shut : s.is_free)) continue;
      ++(is_visible ? found_.n_wrong_visible : found_.n_wrong_hidden);
      fail(is_visible ? "proved visible, but blocked" : "proved hidden, but free",
           name(i) + " and " + name(j) + ", unobstructed F " + number(whole) + ", from " +
               vector_text(s.from + oracle_.center()) + " to " +
               vector_text(s.to + oracle_.center()));
      break;
    }
  }

  /// What the assembly decides for whole clusters, in its coordinates.
  void check_clusters() {
    const double thickness = plane_thickness(mesh_);
    const PatchMesh local = centered(mesh_);
    const ClusterTree tree = make_cluster_tree(local, 8, thickness);
    const BlockerSet blockers = make_blockers(local, thickness);
    const Candidates all = all_candidates(blockers);
    for (long k = 0; k < options_.n_cluster_pairs; ++k) {
      const Cluster& a = tree.clusters[random_() % tree.clusters.size()];
      const Cluster& b = tree.clusters[random_() % tree.clusters.size()];
      if (&a == &b || are_averted(a, b, thickness)) continue;
      const auto kept = possible_blockers(a, b, blockers, all, thickness);
      if (kept && !kept->empty()) continue;
      ++found_.n_cluster_verdicts;
      check_verdict(tree, a, b, kept.has_value());
    }
  }

  void check_verdict(const ClusterTree& tree, const Cluster& a, const Cluster& b, bool is_visible) {
    constexpr int kSegments = 8;
    const auto any_of = [&](const Cluster& c) -> Index {
      return tree.order[c.begin + static_cast<Index>(random_() % (c.end - c.begin))];
    };
    for (int k = 0; k < kSegments; ++k) {
      const Index i = any_of(a);
      const Index j = any_of(b);
      if (i == j) continue;
      const Segment s = random_segment(i, j);
      // Covered patches are left out before clusters are asked.
      if (!(is_visible ? s.is_crossed : s.is_free)) continue;
      ++found_.n_wrong_clusters;
      fail(is_visible ? "clusters visible, but blocked" : "clusters hidden, but free",
           name(i) + " and " + name(j));
      return;
    }
  }

  /// How many standard errors the rays are off a factor known within five of its own errors.
  [[nodiscard]] static double deviation(double factor, double error, std::int64_t hits,
                                        std::int64_t n_rays) {
    // With the square root's arc sine the variance of a share is 1/4n whatever it is (Anscombe
    // 1948).
    const auto n = static_cast<double>(n_rays);
    const auto angle = [n](double count) {
      return std::asin(std::sqrt(std::clamp((count + 0.375) / (n + 0.75), 0.0, 1.0)));
    };
    const auto count = static_cast<double>(hits);
    const double nearest =
        std::clamp(count / n, std::max(0.0, factor - kSigmas * error), factor + kSigmas * error);
    return 2 * std::sqrt(n) * std::abs(angle(count) - angle(n * nearest));
  }

  void check_factors(const Transport& transport) {
    const Eigen::MatrixXd factors = surface_form_factors(mesh_, transport);
    const Eigen::MatrixXd errors = surface_form_factor_errors(mesh_, transport);
    std::vector<std::int32_t> surfaces(mesh_.surface_names.size());
    std::iota(surfaces.begin(), surfaces.end(), 0);
    std::shuffle(surfaces.begin(), surfaces.end(), random_);
    surfaces.resize(std::min<std::size_t>(surfaces.size(), options_.n_surfaces));
    const auto deviates = [&](std::int32_t s, std::size_t t, const RayCounts& rays) {
      return deviation(factors(s, t), errors(s, t), rays.fronts[t], rays.n_rays) > kSigmas;
    };
    for (const std::int32_t s : surfaces) {
      const RayCounts rays = oracle_.shoot(s, options_.n_rays, random_());
      std::optional<RayCounts> more;
      for (std::size_t t = 0; t < rays.fronts.size(); ++t) {
        ++found_.n_factors;
        if (!deviates(s, t, rays)) continue;
        if (!more) more = oracle_.shoot(s, kMoreRays * options_.n_rays, random_());
        if (!deviates(s, t, *more)) continue;
        ++found_.n_wrong_factors;
        const double share =
            static_cast<double>(more->fronts[t]) / static_cast<double>(more->n_rays);
        fail("factor", mesh_.surface_names[s] + " to " + mesh_.surface_names[t] + " is " +
                           number(factors(s, t)) + " ± " + number(errors(s, t)) + ", by rays " +
                           number(share));
      }
    }
  }

  void check_closure(const Transport& transport) {
    const AssemblyReport& report = transport.report();
    found_.n_closed = 1;
    if (!report.closed) {
      ++found_.n_not_closed;
      fail("closure", "not found to be closed");
    } else if (!is_enclosed(mesh_, visibility_, options_.tolerance, options_.seed)) {
      ++found_.n_not_closed;
      fail("closure", "not found to be enclosed by rays");
    }
    found_.n_open_rows = report.open_rows;
    if (report.open_rows > 0) fail("closure", std::to_string(report.open_rows) + " open rows");
    const Eigen::VectorXd sums = transport.apply(Eigen::VectorXd::Ones(mesh_.size()));
    double escaped = 0;
    for (Index i = 0; i < mesh_.size(); ++i) {
      const double expected = 1 - oracle_.contact_share(i);
      const double raw = std::abs(report.row_sums[i] - expected);
      found_.worst_row_sum = std::max(found_.worst_row_sum, raw);
      const Eigen::VectorXd error = rows_of(transport).row_error(i);
      // Errors of neighbours are alike, so they add up. Digits move edges: what touches an edge
      // feels it in proportion to its width.
      const double digits = 20 * oracle_.thickness() / width(i);
      // More than the errors of a row its sum may be off by what was asked.
      const double allowed =
          6 * error.norm() + error.sum() + digits + std::max(1e-6, options_.tolerance);
      if (raw > allowed) {
        ++found_.n_wrong_row_sums;
        fail("row sum", number(report.row_sums[i]) + " of " + name(i) + ", expected " +
                            number(expected) + " ± " + number(allowed));
      }
      escaped += mesh_.area[i] * (expected - sums[i]);
    }
    found_.escaped = std::abs(escaped) / transport.area().sum();
  }

  const FamilyScene& family_scene_;
  const CheckOptions& options_;
  PatchMesh mesh_;
  Oracle oracle_;
  Visibility visibility_;
  std::mt19937_64 random_;
  Findings found_;
};

}  // namespace

Findings& Findings::operator+=(const Findings& other) {
  n_scenes += other.n_scenes;
  n_refused += other.n_refused;
  n_patches += other.n_patches;
  n_visible += other.n_visible;
  n_hidden += other.n_hidden;
  n_wrong_visible += other.n_wrong_visible;
  n_wrong_hidden += other.n_wrong_hidden;
  n_wrong_values += other.n_wrong_values;
  n_cluster_verdicts += other.n_cluster_verdicts;
  n_wrong_clusters += other.n_wrong_clusters;
  n_factors += other.n_factors;
  n_wrong_factors += other.n_wrong_factors;
  n_closed += other.n_closed;
  n_not_closed += other.n_not_closed;
  n_open_rows += other.n_open_rows;
  n_wrong_row_sums += other.n_wrong_row_sums;
  worst_row_sum = std::max(worst_row_sum, other.worst_row_sum);
  escaped = std::max(escaped, other.escaped);
  failures.insert(failures.end(), other.failures.begin(), other.failures.end());
  return *this;
}

Findings check_scene(const FamilyScene& family_scene, const CheckOptions& options) {
  try {
    PatchMesh mesh = meshing::make_patches(family_scene.scene, {.n_patches = options.n_patches});
    return SceneCheck(family_scene, options, std::move(mesh)).run();
  } catch (const MeshError& error) {
    Findings found;
    found.n_scenes = 1;
    found.n_refused = 1;
    found.failures.push_back("refused: " + std::string(error.what()) + " [" + family_scene.name +
                             "]");
    return found;
  }
}

std::optional<SurfaceFactors> surface_factors_of(const FamilyScene& family_scene,
                                                 std::optional<long> n_patches, double tolerance) {
  try {
    const PatchMesh mesh = meshing::make_patches(family_scene.scene, {.n_patches = n_patches});
    const Visibility visibility(mesh);
    const auto transport =
        make_transport(mesh, visibility, {.tolerance = tolerance, .closed = Closed::no});
    return SurfaceFactors{surface_form_factors(mesh, *transport),
                          surface_form_factor_errors(mesh, *transport)};
  } catch (const MeshError&) {
    return std::nullopt;
  }
}

double unexplained_difference(const SurfaceFactors& a, const SurfaceFactors& b,
                              std::string& where) {
  double worst = 0;
  for (Index s = 0; s < a.factors.rows(); ++s) {
    for (Index t = 0; t < a.factors.cols(); ++t) {
      const double difference =
          std::abs(a.factors(s, t) - b.factors(s, t)) - kSigmas * (a.errors(s, t) + b.errors(s, t));
      if (difference <= worst) continue;
      worst = difference;
      std::ostringstream text;
      text.precision(9);
      text << "surface " << s << " to " << t << ": " << a.factors(s, t) << " ± " << a.errors(s, t)
           << " and " << b.factors(s, t) << " ± " << b.errors(s, t);
      where = text.str();
    }
  }
  return worst;
}

}  // namespace radiosity::test
