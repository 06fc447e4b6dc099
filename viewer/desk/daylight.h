#pragma once

#include <optional>

#include "radiosity/scene/solar_position.h"
#include "viewer/desk/desk.h"

namespace viewer {

/// Where the sun stands, radian: azimuth from north by east, in [0, 2π). North is +y where z is up,
/// -z where y is (radiosity::usual_north), whatever the file called so.
struct SunPlace {
  double azimuth = 0;
  double elevation = 0;
};

/// Of the mix's sun or, without one, of the sky's; empty without either.
std::optional<SunPlace> sun_place(const Desk& desk);

/// Puts it there, and lets the sky follow that depends on it; E_n of the sun and E_h of the sky
/// stay. Throws SceneError if there is neither, std::out_of_range unless it is above the horizon.
void set_sun_place(Desk& desk, const SunPlace& place);

/// Where it stands at that place and time. Likewise.
void set_sun_time(Desk& desk, const radiosity::PlaceAndTime& when);

/// The CIE type of the mix's sky, 1 to 16; empty without a sky, or if it is another (Perez').
std::optional<int> sky_type(const Desk& desk);
/// Makes it a sky of that type with the same E_h. Throws SceneError if there is none or no such
/// type.
void set_sky_type(Desk& desk, int type);
/// "8 clear, ...": what a type is like.
const char* sky_type_name(int type);

/// E_h of the mix's sky as it shines, lux; empty without one, or of heat.
std::optional<double> sky_illuminance(const Desk& desk);

}  // namespace viewer
