#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "radiosity/base/geometry.h"
#include "radiosity/scene/photometric_web.h"

namespace radiosity {

/// What lamps give that do not burn as they were measured, as files of IES LM-63 have it.
struct LampTilt {
  /// 1: upright in the luminaire that hangs straight down; lying in it and 2: staying level, 3:
  /// tilted with it.
  int position = 1;
  /// Between the luminaire's axis and straight down, radian, increasing; empty: they always give
  /// the same.
  std::vector<double> angles;
  std::vector<double> factors;  ///< at these, >= 0
};

/// What a photometric file says of a luminaire.
struct Photometry {
  std::filesystem::path file;
  std::string format;    ///< "IES LM-63-2002", "EULUMDAT"...
  std::string name;      ///< of the luminaire, or ""
  std::string maker;     ///< or ""
  PhotometricWeb web;    ///< as one luminaire has it
  double lamp_flux = 0;  ///< of all its lamps, lm; 0 = absolute photometry
  LampTilt tilt;
  double power = 0;                   ///< W
  double along_c0 = 0;                ///< of the luminous opening, m
  double along_c90 = 0;               ///< likewise
  double height = 0;                  ///< 0: flat
  bool is_round = false;              ///< an ellipse or a standing cylinder, of these diameters
  std::vector<std::string> warnings;  ///< what the reader noticed and the user should know
};

/// How the intensity of a web is alike on both sides of planes.
struct WebSymmetry {
  bool is_rotational = false;
  bool across_c0 = false;   ///< alike on both sides of the plane C0-C180
  bool across_c90 = false;  ///< of C90-C270
};
WebSymmetry symmetry_of(const PhotometricWeb& web);

/// The greatest intensity that is given, cd, and its direction in the luminaire's frame.
struct PeakIntensity {
  double intensity = 0;
  Vec3 direction = -Vec3::UnitZ();
};
PeakIntensity peak_intensity(const PhotometricWeb& web);

/// The full angle in a plane C and C + π through the axis, radian: to either side from the axis the
/// last direction whose intensity is the given share of the greatest of all. 1/2: beam angle, 1/10:
/// field angle. (IES LS-1, CIE S 017)
double spread(const PhotometricWeb& web, double plane, double share);

}  // namespace radiosity
