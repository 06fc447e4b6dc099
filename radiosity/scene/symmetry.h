#pragma once

#include <optional>
#include <vector>

#include "radiosity/base/fingerprint.h"
#include "radiosity/base/geometry.h"

namespace radiosity {

/// Moves points without changing distances; may turn left into right: x -> linear x + shift.
struct Motion {
  Eigen::Matrix3d linear = Eigen::Matrix3d::Identity();  ///< orthogonal
  Vec3 shift = Vec3::Zero();                             ///< m

  [[nodiscard]] Vec3 operator()(const Vec3& x) const { return linear * x + shift; }
  [[nodiscard]] bool is_mirrored() const { return linear.determinant() < 0; }
};

/// That which does `first`, then `second`.
Motion after(const Motion& second, const Motion& first);

/// A scene that is a part of a whole, which consists of its images.
struct Symmetry {
  struct Mirror {
    Vec3 point;   ///< of the plane, m
    Vec3 normal;  ///< unit; either side
  };
  struct Rotation {
    Vec3 point;     ///< of the axis, m
    Vec3 axis;      ///< unit
    int folds = 2;  ///< images in all, >= 2: each is turned by 2π/folds
  };
  struct Translation {
    Vec3 step;         ///< m, not 0
    int n_images = 1;  ///< that are reckoned with on each side, >= 1; the whole goes on without end
  };
  std::vector<Mirror> mirrors;            ///< at most 3
  std::optional<Rotation> rotation = {};  ///< with mirrors: of what these make
  std::vector<Translation> translations;  ///< at most 2, not parallel; of what these make

  [[nodiscard]] bool is_none() const {
    return mirrors.empty() && !rotation && translations.empty();
  }
};

/// So many images there may be.
inline constexpr int kMostImages = 4096;

/// What moves the part to each of its images but itself: products of the symmetries, each once.
/// With a motion its inverse is there, too. Throws SceneError where mirrors and rotation have
/// products without end (parallel planes, angles that are no part of a turn), where they do not
/// carry the translations into each other, or if there are more than kMostImages.
std::vector<Motion> image_motions(const Symmetry& symmetry);

/// Adds all that images depend on; nothing if there is no symmetry.
void add_symmetry(Fingerprint& fingerprint, const Symmetry& symmetry);

}  // namespace radiosity
