#include "radiosity/scene/sky.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "radiosity/base/error.h"

namespace radiosity {
namespace {

struct Coefficients {
  double a, b, c, d, e;
};

/// ISO 15469:2004, table 1.
constexpr std::array<Coefficients, 15> kStandardSkies = {{{4, -.7, 0, -1, 0},
                                                          {4, -.7, 2, -1.5, .15},
                                                          {1.1, -.8, 0, -1, 0},
                                                          {1.1, -.8, 2, -1.5, .15},
                                                          {0, -1, 0, -1, 0},
                                                          {0, -1, 2, -1.5, .15},
                                                          {0, -1, 5, -2.5, .3},
                                                          {0, -1, 10, -3, .45},
                                                          {-1, -.55, 2, -1.5, .15},
                                                          {-1, -.55, 5, -2.5, .3},
                                                          {-1, -.55, 10, -3, .45},
                                                          {-1, -.32, 10, -3, .45},
                                                          {-1, -.32, 16, -3, .3},
                                                          {-1, -.15, 16, -3, .3},
                                                          {-1, -.15, 24, -2.8, .15}}};

constexpr double kClearness = 1.041;  // κ, of Z in radian

/// Upper ends of the first seven ranges of clearness.
constexpr std::array<double, 7> kClearnessEnds = {1.065, 1.23, 1.5, 1.95, 2.8, 4.5, 6.2};

/// Per range four numbers each for a, b, c, d, e: x = x1 + x2 Z + Δ (x3 + x4 Z).
constexpr std::array<std::array<double, 20>, 8> kPerez = {
    {{1.3525, -0.2576, -0.2690, -1.4366, -0.7670, 0.0007, 1.2734, -0.1233, 2.8000,  0.6004,
      1.2375, 1.0000,  1.8734,  0.6297,  0.9738,  0.2809, 0.0356, -0.1246, -0.5718, 0.9938},
     {-1.2219, -0.7730, 1.4148,  1.1016,  -0.2054, 0.0367, -3.9128, 0.9156, 6.9750,  0.1774,
      6.4477,  -0.1239, -1.5798, -0.5081, -1.7812, 0.1080, 0.2624,  0.0672, -0.2190, -0.4285},
     {-1.1000,  -0.2515, 0.8952,  0.0156, 0.2782, -0.1812, -4.5000, 1.1766, 24.7219, -13.0812,
      -37.7000, 34.8438, -5.0000, 1.5218, 3.9229, -2.6204, -0.0156, 0.1597, 0.4199,  -0.5562},
     {-0.5484,  -0.6654, -0.2672, 0.7117, 0.7234, -0.6219, -5.6812, 2.6297,  33.3389, -18.3000,
      -62.2500, 52.0781, -3.5000, 0.0016, 1.1477, 0.1062,  0.4659,  -0.3296, -0.0876, -0.0329},
     {-0.6000,  -0.3566, -2.5000, 2.3250,  0.2937, 0.0496, -5.6812, 1.8415, 21.0000, -4.7656,
      -21.5906, 7.2492,  -3.5000, -0.1554, 1.4062, 0.3988, 0.0032,  0.0766, -0.0656, -0.1294},
     {-1.0156, -0.3670, 1.0078,  1.4051,  0.2875,  -0.5328, -3.8500, 3.3750, 14.0000, -0.9999,
      -7.1406, 7.5469,  -3.4000, -0.1078, -1.0750, 1.5702,  -0.0672, 0.4016, 0.3017,  -0.4844},
     {-1.0000, 0.0211,  0.5025,  -0.5119, -0.3000, 0.1922, 0.7023, -1.6317, 19.0000, -5.0000,
      1.2438,  -1.9094, -4.0000, 0.0250,  0.3844,  0.2656, 1.0468, -0.3788, -2.4517, 1.4656},
     {-1.0500,  0.0289,  0.4260,  0.3590, -0.3250, 0.1156, 0.7781, 0.0025,  31.0625, -14.5000,
      -46.1148, 55.3750, -7.2312, 0.4050, 13.3500, 0.6234, 1.5000, -0.6426, 1.8564,  0.5636}}};

/// Below this cosine of Z, exp(b/cosZ) is 0 for all b of the standard, of whatever sign at a loss
/// of nothing: the horizon itself has no area.
constexpr double kHorizon = 1e-9;

}  // namespace

double SkyDistribution::value(double cos_zenith, double cos_sun) const {
  if (kind == Kind::overcast) return 1 + 2 * cos_zenith;
  const double gradation = a == 0 ? 1 : 1 + a * std::exp(b / std::max(cos_zenith, kHorizon));
  if (!needs_sun()) return std::max(0., gradation);
  const double chi = std::acos(std::clamp(cos_sun, -1., 1.));
  const double at_right_angle = kind == Kind::cie ? std::exp(d * kPi / 2) : 0;
  const double indicatrix = 1 + c * (std::exp(d * chi) - at_right_angle) + e * cos_sun * cos_sun;
  return std::max(0., gradation) * std::max(0., indicatrix);
}

SkyDistribution cie_sky(int type) {
  if (type == 16) return {.kind = SkyDistribution::Kind::overcast};
  if (type < 1 || type > 16) {
    throw SceneError("sky type " + std::to_string(type) + ", expected 1 to 16 (ISO 15469)");
  }
  const Coefficients& x = kStandardSkies[static_cast<std::size_t>(type - 1)];
  return {SkyDistribution::Kind::cie, x.a, x.b, x.c, x.d, x.e};
}

double sky_clearness(double diffuse, double direct_normal, double sun_zenith) {
  const double turbid = kClearness * std::pow(sun_zenith, 3);
  return ((diffuse + direct_normal) / diffuse + turbid) / (1 + turbid);
}

double sky_brightness(double diffuse, double sun_zenith, double extraterrestrial) {
  const double height = 90 - sun_zenith * 180 / kPi;
  const double air_mass =
      1 / (std::cos(sun_zenith) + 0.50572 * std::pow(height + 6.07995, -1.6364));
  return air_mass * diffuse / extraterrestrial;
}

SkyDistribution perez_sky(double clearness, double brightness, double sun_zenith) {
  const auto range = static_cast<std::size_t>(
      std::upper_bound(kClearnessEnds.begin(), kClearnessEnds.end(), clearness) -
      kClearnessEnds.begin());
  const std::array<double, 20>& x = kPerez[range];
  const auto coefficient = [&](std::size_t k) {
    return x[4 * k] + x[4 * k + 1] * sun_zenith +
           brightness * (x[4 * k + 2] + x[4 * k + 3] * sun_zenith);
  };
  SkyDistribution result{.kind = SkyDistribution::Kind::perez,
                         .a = coefficient(0),
                         .b = coefficient(1),
                         .c = coefficient(2),
                         .d = coefficient(3),
                         .e = coefficient(4)};
  if (range == 0) {  // overcast: two of them have forms of their own
    result.c = std::exp(std::pow(brightness * (x[8] + x[9] * sun_zenith), x[10])) - x[11];
    result.d = -std::exp(brightness * (x[12] + x[13] * sun_zenith)) + x[14] + brightness * x[15];
  }
  return result;
}

}  // namespace radiosity
