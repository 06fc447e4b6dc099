#pragma once

#include <mutex>
#include <optional>

#include "radiosity/base/geometry.h"
#include "radiosity/base/progress.h"
#include "radiosity/picture/pinhole.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/scene/scene.h"
#include "radiosity/visibility/visibility.h"

namespace radiosity {

/// A point on the emitting side of a patch, m.
struct SurfacePoint {
  std::int32_t patch;
  Vec3 position;
};

/// The place in the part of a symmetric whole of which a point of the whole is an image.
SurfacePoint in_part(const PatchMesh& part, const SurfacePoint& point);

/// The rays of a pinhole camera through the pixels of a picture, several in each.
class PrimaryRays {
 public:
  /// `samples` is a square number. `visibility` must outlive the rays.
  PrimaryRays(const Visibility& visibility, const Camera& camera, int width, int height,
              int samples);

  /// Number of rays in each pixel.
  [[nodiscard]] int n_samples() const { return samples_per_side_ * samples_per_side_; }

  /// The first emitting side that ray k of pixel (x, y) meets; backs are passed through.
  [[nodiscard]] std::optional<SurfacePoint> first_front(int x, int y, int k) const;

 private:
  const Visibility& visibility_;
  Pinhole pinhole_;
  int samples_per_side_;
};

/// Reports a picture's rows as they are finished, one call at a time.
class RowCounter {
 public:
  RowCounter(const Progress& progress, int n_rows) : progress_(progress), n_rows_(n_rows) {}
  void add_rows(int n);

 private:
  const Progress& progress_;
  int n_rows_;
  int done_ = 0;
  std::mutex mutex_;
};

}  // namespace radiosity
