// UGR tables: rooms against radiosity made in another way, and laws.
#include "study/ugr_table.h"

#include <gtest/gtest.h>

#include <cmath>

#include "radiosity/base/error.h"

namespace study {
namespace {

using radiosity::kPi;

/// An opening of 0.6 x 0.3 m with I(γ, C) = 100 cd cosγ (1 + a sin²γ cos 2C), 0 upwards.
radiosity::Photometry panel(double a) {
  radiosity::Photometry photometry;
  photometry.file = "panel.ies";
  photometry.along_c0 = 0.6;
  photometry.along_c90 = 0.3;
  radiosity::PhotometricWeb& web = photometry.web;
  web.type = radiosity::PhotometricWeb::Type::c;
  constexpr int kPolar = 91;  // 1 degree: cos is 4e-5 off between, relative to its peak
  constexpr int kAzimuth = 73;
  for (int k = 0; k < kPolar; ++k) web.polar.push_back(k * kPi / 180);
  for (int k = 0; k < kAzimuth; ++k) web.azimuth.push_back(k * kPi / 36);
  web.intensity.resize(kPolar, kAzimuth);
  for (int c = 0; c < kAzimuth; ++c) {
    for (int g = 0; g < kPolar; ++g) {
      const double sine = std::sin(web.polar[static_cast<std::size_t>(g)]);
      web.intensity(g, c) =
          100 * std::cos(web.polar[static_cast<std::size_t>(g)]) *
          (1 + a * sine * sine * std::cos(2 * web.azimuth[static_cast<std::size_t>(c)]));
    }
  }
  return photometry;
}

UgrTableOptions room(double across, double along, double spacing) {
  return {.rooms = {{across, along}}, .reflectances = {{0.7, 0.5, 0.2}}, .spacing = spacing};
}

// The figures are of NumPy: patches of an eighth of H with form factors by points, closed, light at
// nine points of each, all luminaires one by one; extrapolated in the square of the patches' size,
// from a quarter of H on, which moves them by 0.002. The gaps of the table are worth 0.02.
TEST(UgrTable, IsThatOfRadiosityMadeInAnotherWay) {
  constexpr double kNear = 0.025;
  const UgrTable even = make_ugr_table(panel(0), room(2, 3, 0.5));
  EXPECT_NEAR(even.along_c0(0, 0), 12.2126, kNear);
  EXPECT_NEAR(even.along_c90(0, 0), even.along_c0(0, 0), 2e-3);
  EXPECT_NEAR(make_ugr_table(panel(0), room(4, 2, 1)).along_c0(0, 0), 10.886, kNear);
  const UgrTable uneven = make_ugr_table(panel(0.5), room(2, 3, 0.5));
  EXPECT_NEAR(uneven.along_c0(0, 0), 14.148, kNear);
  EXPECT_NEAR(uneven.along_c90(0, 0), 9.657, kNear);
}

// Twice the flux is 8 lg 2 more; twice the size of everything at the same illuminance: the sources'
// luminance is the same and so are their solid angles, for openings of twice the size and four
// times the intensity.
TEST(UgrTable, ScalesAsItsFormula) {
  const UgrTableOptions options = room(2, 2, 1);
  const double base = make_ugr_table(panel(0.3), options).along_c0(0, 0);
  radiosity::Photometry bright = panel(0.3);
  bright.web.intensity *= 2;
  EXPECT_NEAR(make_ugr_table(bright, options).along_c0(0, 0), base + 8 * std::log10(2), 1e-3);
  radiosity::Photometry large = panel(0.3);
  large.web.intensity *= 4;
  large.along_c0 *= 2;
  large.along_c90 *= 2;
  UgrTableOptions wide = options;
  wide.height = 4;
  EXPECT_NEAR(make_ugr_table(large, wide).along_c0(0, 0), base, 1e-3);
}

TEST(UgrTable, RefusesRoomsThatAreNone) {
  for (const UgrTableOptions& bad : {room(2, 2.3, 0.25), room(0, 2, 1), room(2, 2, -1)}) {
    EXPECT_THROW((void)make_ugr_table(panel(0), bad), radiosity::SceneError);
  }
  UgrTableOptions white = room(2, 2, 1);
  white.reflectances = {{1, 0.5, 0.2}};
  EXPECT_THROW((void)make_ugr_table(panel(0), white), radiosity::SceneError);
}

TEST(UgrTable, NeedsALuminousOpening) {
  radiosity::Photometry point = panel(0);
  point.along_c90 = 0;
  EXPECT_THROW((void)make_ugr_table(point, room(2, 2, 1)), radiosity::SceneError);
}

}  // namespace
}  // namespace study
