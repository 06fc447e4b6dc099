#include "radiosity/picture/primary_rays.h"

#include <cmath>

namespace radiosity {
namespace {

/// Sample k of a pixel cut into n x n cells, in [0, 1)²: one in each cell, and all n² in different
/// rows and columns of the n² x n² grid, so that edges near the axes are smooth too.
Eigen::Vector2d sample_position(int k, int n) {
  const int column = k % n;
  const int row = k / n;
  return {(column + (row + 0.5) / n) / n, (row + (column + 0.5) / n) / n};
}

}  // namespace

SurfacePoint in_part(const PatchMesh& part, const SurfacePoint& point) {
  if (point.patch < part.size()) return point;
  const auto n = static_cast<std::int32_t>(part.size());
  const Motion& image = part.images[point.patch / n - 1];
  return {point.patch % n, image.linear.transpose() * (point.position - image.shift)};
}

PrimaryRays::PrimaryRays(const Visibility& visibility, const Camera& camera, int width, int height,
                         int samples)
    : visibility_(visibility),
      pinhole_(camera, width, height),
      samples_per_side_(static_cast<int>(std::lround(std::sqrt(samples)))) {}

std::optional<SurfacePoint> PrimaryRays::first_front(int x, int y, int k) const {
  const Eigen::Vector2d place = Eigen::Vector2d(x, y) + sample_position(k, samples_per_side_);
  const Vec3 direction = pinhole_.direction(place[0], place[1]);
  const std::optional<Hit> hit = visibility_.first_front_hit(pinhole_.position(), direction);
  if (!hit) return std::nullopt;
  return SurfacePoint{hit->patch, pinhole_.position() + hit->distance * direction};
}

void RowCounter::add_rows(int n) {
  if (!progress_.report) return;
  const std::scoped_lock lock(mutex_);
  done_ += n;
  progress_.report("picture", done_, n_rows_, "rows");
}

}  // namespace radiosity
