#include "radiosity/picture/shooting_preview.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <chrono>
#include <span>

#include "radiosity/base/parallel.h"
#include "radiosity/polygon/point_to_polygon.h"

namespace radiosity {
namespace {

/// About so many groups shoot; at 10,000 patches they take a second for one bounce of all light.
constexpr Index kGroups = 256;
/// Parts further away than so many of their radii are point sources.
constexpr double kFar = 4;
/// Receivers that a thread takes at once.
constexpr std::ptrdiff_t kGrain = 64;
/// Relative error of sums over all patches, generously.
constexpr double kRounding = 1e-12;

std::vector<bool> rows_with_light(const Eigen::MatrixXd& exitance) {
  std::vector<bool> result(static_cast<std::size_t>(exitance.rows()));
  for (Index i = 0; i < exitance.rows(); ++i) result[i] = !exitance.row(i).isZero(0);
  return result;
}

}  // namespace

ShootingPreview::ShootingPreview(const PatchMesh& mesh, const Visibility& visibility,
                                 const Eigen::MatrixXd& exitance,
                                 const Eigen::MatrixXd& reflectance)
    : mesh_(mesh),
      visibility_(visibility),
      sources_(make_shooting_sources(mesh, rows_with_light(exitance), mesh.size() / kGroups)),
      area_(Eigen::VectorXd::Map(mesh.area.data(), mesh.size())),
      exitance_(exitance),
      reflectance_(reflectance),
      irradiance_(RowMatrix::Zero(exitance.rows(), exitance.cols())),
      unshot_(exitance),
      arrived_(irradiance_),
      part_light_(static_cast<Index>(sources_.nodes.size()), exitance.cols()),
      thickness_(plane_thickness(mesh)) {
  assert(exitance.rows() == mesh.size());
  assert(reflectance.rows() == mesh.size() && reflectance.cols() == exitance.cols());
}

void ShootingPreview::shoot() {
  if (unshot_.isZero(0)) return;
  const ShootingSources::Group& group = sources_.groups[brightest_group()];
  prepare_parts(group);
  arrived_.setZero();
  parallel_for(
      mesh_.size(),
      [&](std::ptrdiff_t i) {
        const auto receiver = static_cast<std::int32_t>(i);
        const double share = visible_share(group, receiver);
        if (share == 0) return;
        gather(group, receiver, arrived_.row(i));
        arrived_.row(i) *= share;
      },
      kGrain);
  const Eigen::RowVectorXd sent = sources_.nodes[group.node].area * part_light_.row(group.node);
  const Eigen::RowVectorXd received = area_.transpose() * arrived_;
  for (Index c = 0; c < sent.size(); ++c) {
    if (received[c] > sent[c]) arrived_.col(c) *= sent[c] / received[c];
  }
  for (const std::int32_t i : group.patches) unshot_.row(i).setZero();
  irradiance_ += arrived_;
  unshot_ += reflectance_.cwiseProduct(arrived_);
  ++n_shots_;
}

void ShootingPreview::shoot(double seconds, const Progress& progress) {
  const auto start = std::chrono::steady_clock::now();
  const auto elapsed = [start] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  do {
    progress.check();
    shoot();
    if (progress.report) progress.report("preview", 1 - unshot_share(), 1, "of the light");
  } while (elapsed() < seconds && !unshot_.isZero(0));
}

std::size_t ShootingPreview::brightest_group() const {
  const Eigen::VectorXd power = area_.cwiseProduct(unshot_.rowwise().sum());
  std::size_t brightest = 0;
  double most = -1;
  for (std::size_t g = 0; g < sources_.groups.size(); ++g) {
    double sum = 0;
    for (const std::int32_t i : sources_.groups[g].patches) sum += power[i];
    if (sum > most) {
      most = sum;
      brightest = g;
    }
  }
  return brightest;
}

void ShootingPreview::prepare_parts(const ShootingSources::Group& group) {
  for (std::int32_t k = sources_.nodes[group.node].end - 1; k >= group.node; --k) {
    const ShootingSources::Node& node = sources_.nodes[k];
    if (node.patch >= 0) {
      part_light_.row(k) = unshot_.row(node.patch);
      continue;
    }
    const std::int32_t first = k + 1;
    const std::int32_t second = sources_.nodes[first].end;
    part_light_.row(k) = (sources_.nodes[first].area * part_light_.row(first) +
                          sources_.nodes[second].area * part_light_.row(second)) /
                         node.area;
  }
}

double ShootingPreview::visible_share(const ShootingSources::Group& group,
                                      std::int32_t receiver) const {
  const ShootingSources::Node& whole = sources_.nodes[group.node];
  const Vec3& place = mesh_.centroid[receiver];
  const Vec3& normal = mesh_.normal[receiver];
  const Vec3 way = place - whole.center;
  const bool is_behind_group = mesh_.normal[group.patches.front()].dot(way) <= thickness_;
  if (is_behind_group || normal.dot(way) >= whole.radius) return 0;

  std::array<Vec3, ShootingSources::kPoints> from;
  std::array<Vec3, ShootingSources::kPoints> to;
  std::size_t n = 0;
  for (int k = 0; k < ShootingSources::kPoints; ++k) {
    if (normal.dot(group.points[k] - place) <= 0) continue;
    from[n] = inner_point(mesh_, receiver, k);
    to[n++] = group.points[k];
  }
  // Only a border of the group reaches above the horizon of the receiver.
  if (n == 0) return 1;
  const std::uint32_t blocked = visibility_.blocked(
      std::span(from).first(n), std::span(to).first(n), receiver, group.patches.front());
  return 1 - std::popcount(blocked) / static_cast<double>(n);
}

void ShootingPreview::gather(const ShootingSources::Group& group, std::int32_t receiver,
                             Eigen::Ref<Eigen::RowVectorXd> irradiance) const {
  const Vec3& place = mesh_.centroid[receiver];
  const Vec3& normal = mesh_.normal[receiver];
  const Vec3& source_normal = mesh_.normal[group.patches.front()];
  const std::int32_t end = sources_.nodes[group.node].end;
  for (std::int32_t k = group.node; k < end;) {
    const ShootingSources::Node& node = sources_.nodes[k];
    const Vec3 way = node.center - place;
    const double square = way.squaredNorm();
    const bool is_far = square > kFar * kFar * node.radius * node.radius;
    if (!is_far && node.patch < 0) {
      ++k;
      continue;
    }
    double factor = 0;
    if (is_far) {
      const double cosines = std::max(0., normal.dot(way)) * std::max(0., -source_normal.dot(way));
      factor = node.area * cosines / (kPi * square * square);
    } else {
      std::array<Vec3, 4> corners;
      const int n_corners = mesh_.n_corners(node.patch);
      for (int c = 0; c < n_corners; ++c) corners[c] = mesh_.corner(node.patch, c);
      factor = point_to_polygon(place, normal, std::span(corners).first(n_corners));
    }
    irradiance += factor * part_light_.row(k);
    k = node.end;
  }
}

Eigen::MatrixXd ShootingPreview::radiosity() const {
  return exitance_ + reflectance_.cwiseProduct(irradiance_);
}

Eigen::MatrixXd ShootingPreview::with_ambient() const {
  Eigen::MatrixXd result = radiosity();
  const double total = area_.sum();
  for (Index c = 0; c < result.cols(); ++c) {
    const double absorbing_area = total - area_.dot(reflectance_.col(c));
    if (absorbing_area <= kRounding * total) continue;
    const double ambient = area_.dot(unshot_.col(c)) / absorbing_area;
    result.col(c) += ambient * reflectance_.col(c);
  }
  return result;
}

double ShootingPreview::unshot_share() const {
  const double emitted = area_.dot(exitance_.rowwise().sum());
  return emitted > 0 ? area_.dot(unshot_.rowwise().sum()) / emitted : 0;
}

}  // namespace radiosity
