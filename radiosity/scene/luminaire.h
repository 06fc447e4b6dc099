#pragma once

#include <Eigen/Core>
#include <array>
#include <string>

#include "radiosity/base/geometry.h"

namespace radiosity {

/// A luminaire of a scene: its luminous opening, or a point or several, emit by a photometric web
/// and share its flux.
struct Luminaire {
  std::string name;
  int photometry = 0;            ///< index into Scene::photometries
  Vec3 position = Vec3::Zero();  ///< m
  /// Columns: what x (C0), y (C90) and z of the web's frame are in the scene; a rotation. The axis
  /// of the web points along -z.
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  double lumens = 0;              ///< its flux, lm; 0 = that of the web
  double dimming = 1;             ///< of that again, >= 0; 0 = it is off
  double maintenance_factor = 1;  ///< of its own, (0, 1]: LightPlan
  Vec3 up = Vec3::UnitZ();        ///< unit; how its lamps burn is told from that (LampTilt)
  /// Points along C0 and along C90 of the luminous opening (luminaire_points); {0, 0}: as many as
  /// it takes, wherever it lights (LuminousOpening), or one if it has no extent.
  std::array<int, 2> divisions{0, 0};
  Eigen::VectorXd watts_per_lumen;  ///< W in each band for each lumen (of wavelengths W/nm)
};

/// The axes of a luminaire whose axis points in a `direction` of unit length: C0 is horizontal, to
/// the right for who looks along the direction, and along `east` where that is straight up or down;
/// then turned by `turn` (radian) about the axis, counter-clockwise seen from behind. `up` and
/// `east` are unit vectors, normal to each other.
Eigen::Matrix3d aimed_axes(const Vec3& direction, double turn, const Vec3& up, const Vec3& east);

/// The same with C0 along what of a vector is normal to the direction; not parallel to it.
Eigen::Matrix3d aimed_axes(const Vec3& direction, const Vec3& c0);

}  // namespace radiosity
