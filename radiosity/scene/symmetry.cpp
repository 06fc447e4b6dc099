#include "radiosity/scene/symmetry.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "radiosity/base/error.h"

namespace radiosity {
namespace {

/// Products of motions are the same if nothing differs by more than this, relative to the distances
/// of their planes and axes from the origin.
constexpr double kSameMotion = 1e-9;
/// Sines and cosines below this are rounding: quarter turns are exact.
constexpr double kNoSine = 1e-15;
/// Sine of the angle below which translations count as parallel.
constexpr double kParallel = 1e-6;

Motion about(const Vec3& point, const Eigen::Matrix3d& linear) {
  return {linear, point - linear * point};
}

Motion reflection(const Symmetry::Mirror& mirror) {
  return {Eigen::Matrix3d::Identity() - 2 * mirror.normal * mirror.normal.transpose(),
          2 * mirror.normal.dot(mirror.point) * mirror.normal};
}

/// (Rodrigues 1840)
Motion turn(const Symmetry::Rotation& rotation, int k) {
  const double angle = 2 * kPi * k / rotation.folds;
  const auto rounded = [](double value) { return std::abs(value) < kNoSine ? 0 : value; };
  const double sine = rounded(std::sin(angle));
  const double cosine = rounded(std::cos(angle));
  const Vec3& n = rotation.axis;
  Eigen::Matrix3d cross;
  cross << 0, -n.z(), n.y(), n.z(), 0, -n.x(), -n.y(), n.x(), 0;
  const Eigen::Matrix3d linear =
      cosine * Eigen::Matrix3d::Identity() + sine * cross + (1 - cosine) * n * n.transpose();
  return about(rotation.point, linear);
}

bool are_alike(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) {
  return (a - b).cwiseAbs().maxCoeff() <= kSameMotion;
}

[[noreturn]] void refuse_number() {
  throw SceneError(
      "there are more than " + std::to_string(kMostImages) +
      " images; expected fewer folds or a shorter cut-off, and mirror planes at angles "
      "that are parts of a turn");
}

/// All products of mirrors and turns.
class FiniteGroup {
 public:
  explicit FiniteGroup(const Symmetry& symmetry) {
    for (const Symmetry::Mirror& mirror : symmetry.mirrors) {
      scale_ = std::max(scale_, mirror.point.norm());
      generators_.push_back(reflection(mirror));
    }
    if (symmetry.rotation) {
      scale_ = std::max(scale_, symmetry.rotation->point.norm());
      for (int k = 1; k < symmetry.rotation->folds; ++k) {
        if (k == kMostImages) refuse_number();
        motions_.push_back(turn(*symmetry.rotation, k));
      }
      generators_.push_back(motions_.front());
    }
    close();
  }

  [[nodiscard]] const std::vector<Motion>& motions() const { return motions_; }

 private:
  void close() {
    motions_.insert(motions_.begin(), Motion{});
    if (generators_.size() == 1 && motions_.size() > 1) return;  // turns only
    for (std::size_t k = 0; k < motions_.size(); ++k) {
      for (const Motion& generator : generators_) {
        const Motion product = after(generator, motions_[k]);
        if (!is_known(product)) motions_.push_back(product);
        if (motions_.size() > kMostImages) refuse_number();
      }
    }
  }

  [[nodiscard]] bool is_known(const Motion& motion) const {
    return std::any_of(motions_.begin(), motions_.end(), [&](const Motion& known) {
      if (!are_alike(known.linear, motion.linear)) return false;
      const double distance = (known.shift - motion.shift).norm();
      if (distance <= kSameMotion * scale_) return true;
      throw SceneError(
          "mirror planes or axes that have no point in common repeat the part without "
          "end; expected a \"translation\" for that");
    });
  }

  double scale_ = 0;  // m
  std::vector<Motion> generators_;
  std::vector<Motion> motions_;
};

/// Whether a translation is carried into one of all, or its opposite.
bool is_carried(const Motion& motion, const Symmetry::Translation& translation,
                const std::vector<Symmetry::Translation>& all) {
  const Vec3 moved = motion.linear * translation.step;
  return std::any_of(all.begin(), all.end(), [&](const Symmetry::Translation& other) {
    const double tolerance = kSameMotion * other.step.norm();
    return other.n_images == translation.n_images &&
           std::min((moved - other.step).norm(), (moved + other.step).norm()) <= tolerance;
  });
}

void check_translations(const Symmetry& symmetry, const std::vector<Motion>& motions) {
  if (symmetry.translations.size() == 2) {
    const Vec3& a = symmetry.translations[0].step;
    const Vec3& b = symmetry.translations[1].step;
    if (!(a.cross(b).norm() > kParallel * a.norm() * b.norm())) {
      throw SceneError("the two translations are parallel; expected one, or two directions");
    }
  }
  for (const Symmetry::Translation& translation : symmetry.translations) {
    const bool is_whole = std::all_of(motions.begin(), motions.end(), [&](const Motion& motion) {
      return is_carried(motion, translation, symmetry.translations);
    });
    if (!is_whole) {
      throw SceneError(
          "mirrors and rotation do not carry the translations into each other; expected "
          "planes along or across them");
    }
  }
}

}  // namespace

Motion after(const Motion& second, const Motion& first) {
  return {second.linear * first.linear, second(first.shift)};
}

std::vector<Motion> image_motions(const Symmetry& symmetry) {
  const FiniteGroup group(symmetry);
  const std::vector<Motion>& motions = group.motions();
  check_translations(symmetry, motions);
  std::vector<Vec3> shifts{Vec3::Zero()};
  for (const Symmetry::Translation& translation : symmetry.translations) {
    const std::vector<Vec3> before = shifts;
    for (int k = 1; k <= translation.n_images; ++k) {
      for (const Vec3& shift : before) {
        shifts.emplace_back(shift + k * translation.step);
        shifts.emplace_back(shift - k * translation.step);
      }
      if (shifts.size() * motions.size() > kMostImages) refuse_number();
    }
  }
  std::vector<Motion> images;
  for (const Vec3& shift : shifts) {
    for (const Motion& motion : motions) images.push_back({motion.linear, motion.shift + shift});
  }
  images.erase(images.begin());  // the part itself
  return images;
}

void add_symmetry(Fingerprint& fingerprint, const Symmetry& symmetry) {
  for (const Symmetry::Mirror& mirror : symmetry.mirrors) {
    fingerprint.add(mirror.point);
    fingerprint.add(mirror.normal);
  }
  if (symmetry.rotation) {
    fingerprint.add(symmetry.rotation->point);
    fingerprint.add(symmetry.rotation->axis);
    fingerprint.add(symmetry.rotation->folds);
  }
  for (const Symmetry::Translation& translation : symmetry.translations) {
    fingerprint.add(translation.step);
    fingerprint.add(translation.n_images);
  }
}

}  // namespace radiosity
