#pragma once

#include <Eigen/Core>
#include <optional>

#include "radiosity/base/geometry.h"

namespace radiosity {

/// How bright parts of the sky are next to each other: φ(Z) f(χ), Z from the zenith and χ from the
/// sun, radian.
struct SkyDistribution {
  enum class Kind {
    cie,  ///< φ = 1 + a exp(b/cosZ), f = 1 + c (exp(dχ) - exp(dπ/2)) + e cos²χ (ISO 15469)
    overcast,  ///< the traditional overcast sky, 1 + 2 cosZ (Moon & Spencer 1942): type 16
    perez      ///< as `cie`, without the term exp(dπ/2) (Perez, Seals & Michalsky 1993)
  };
  Kind kind = Kind::cie;
  double a = 0;
  double b = -1;
  double c = 0;
  double d = -1;
  double e = 0;

  /// φ(Z) f(χ) of the cosines; 0 where a fitted one (Perez) would be negative.
  [[nodiscard]] double value(double cos_zenith, double cos_sun) const;
  /// Whether it depends on where the sun is.
  [[nodiscard]] bool needs_sun() const { return c != 0 || e != 0; }
  /// Whether it is the same everywhere.
  [[nodiscard]] bool is_uniform() const { return kind == Kind::cie && a == 0 && !needs_sun(); }
};

/// Of a type from 1 to 16 (ISO 15469:2004 table 1; 16 as above). Throws SceneError for another.
SkyDistribution cie_sky(int type);

/// The sky's clearness ε = ((E_d + E_n)/E_d + κ Z_s³) / (1 + κ Z_s³), κ = 1.041, of the diffuse
/// horizontal and the normal direct irradiance (W/m²) with the sun at Z_s from the zenith, radian.
double sky_clearness(double diffuse, double direct_normal, double sun_zenith);
/// Its brightness Δ = m E_d / E_0, m the air mass (Kasten & Young 1989) and E_0 the irradiance
/// outside the air, W/m².
double sky_brightness(double diffuse, double sun_zenith, double extraterrestrial);
/// Perez' all-weather sky of these (Solar Energy 50 (1993) 235, table 1).
SkyDistribution perez_sky(double clearness, double brightness, double sun_zenith);

/// Light from where no surface is: from a sky above the horizon, and below it from the ground, an
/// endless diffuse plane that nothing shadows.
struct Sky {
  SkyDistribution distribution;
  Vec3 up = Vec3(0, 0, 1);  ///< unit length
  /// Unit length; only those who bring another sun want it. Absent: usual_north.
  std::optional<Vec3> north = {};
  Vec3 towards_sun = Vec3(0, 0, 1);    ///< unit length
  Eigen::VectorXd zenith_radiance;     ///< L_z, per band, W/(m² sr), >= 0
  Eigen::VectorXd ground_reflectance;  ///< per band, in [0, 1]

  /// L / L_z in a direction of unit length above the horizon.
  [[nodiscard]] double ratio(const Vec3& direction) const {
    return distribution.value(up.dot(direction), towards_sun.dot(direction)) / value_at_zenith();
  }
  [[nodiscard]] double value_at_zenith() const {
    return distribution.value(1, up.dot(towards_sun));
  }
};

}  // namespace radiosity
