#pragma once

#include <array>
#include <string_view>

/// The keys that each object of a JSON scene file may have, as docs/scene.schema.json lists them.
namespace io::keys {

inline constexpr auto kScene = std::to_array<std::string_view>(
    {"$schema", "name", "description", "unit", "precision", "bands", "materials", "surfaces",
     "environment", "camera", "views", "closed", "sun", "sky", "symmetry", "luminaires", "grids",
     "observers", "maintenance_factor"});

inline constexpr auto kBands = std::to_array<std::string_view>({"thermal", "split_wavelength"});

inline constexpr auto kSun = std::to_array<std::string_view>(
    {"direction", "azimuth_deg", "elevation_deg", "up", "north", "irradiance"});

inline constexpr auto kLuminaire = std::to_array<std::string_view>(
    {"name", "description", "file", "position", "aim", "direction", "rotations_deg", "turn_deg",
     "c0", "up", "dimming", "lumens", "maintenance_factor", "spectrum", "watts_per_lumen", "array",
     "points"});

inline constexpr auto kLuminaireArray =
    std::to_array<std::string_view>({"rows", "columns", "row_step", "column_step"});

inline constexpr auto kSky = std::to_array<std::string_view>(
    {"type", "perez", "weather", "distribution", "zenith_radiance", "horizontal_irradiance",
     "zenith_luminance", "horizontal_illuminance", "ground_reflectance", "direction", "azimuth_deg",
     "elevation_deg", "latitude", "longitude", "time", "up", "north"});

/// An all-weather sky by what is measured below it.
inline constexpr auto kPerez = std::to_array<std::string_view>(
    {"direct_normal", "diffuse_horizontal", "direct_normal_illuminance",
     "diffuse_horizontal_illuminance"});

inline constexpr auto kWeather = std::to_array<std::string_view>({"file", "month", "day", "hour"});

inline constexpr auto kDistribution =
    std::to_array<std::string_view>({"form", "a", "b", "c", "d", "e"});

inline constexpr auto kGlazing =
    std::to_array<std::string_view>({"transmittance", "refractive_index", "internal_transmittance",
                                     "by_thickness", "thickness", "absorption"});

inline constexpr auto kEmission = std::to_array<std::string_view>(
    {"radiance", "exitance", "power", "temperature", "heat_flux", "heat_power", "adiabatic"});

inline constexpr auto kEnvironment =
    std::to_array<std::string_view>({"radiance", "exitance", "temperature"});

/// An emission may stand in the material itself or in its "emission".
inline constexpr auto kMaterial = std::to_array<std::string_view>(
    {"name", "description", "reflectance", "emissivity", "emission", "radiance", "exitance",
     "power", "temperature", "heat_flux", "heat_power", "adiabatic", "solar", "infrared", "glazing",
     "maintenance_factor"});

/// What a material is to the sun's light.
inline constexpr auto kSolar = std::to_array<std::string_view>({"absorptivity"});

/// What it is to thermal radiation.
inline constexpr auto kInfrared = std::to_array<std::string_view>({"emissivity"});

inline constexpr auto kSpectrum = std::to_array<std::string_view>({"csv", "column"});

inline constexpr auto kSurface = std::to_array<std::string_view>(
    {"name", "description", "material", "back", "two_sided", "shield", "light", "mesh", "object",
     "transform", "unit", "polygons", "vertices"});

inline constexpr auto kTransform =
    std::to_array<std::string_view>({"scale", "rotate", "translate", "matrix"});

inline constexpr auto kRotation = std::to_array<std::string_view>({"axis", "degrees"});

inline constexpr auto kSymmetry =
    std::to_array<std::string_view>({"mirror", "rotation", "translation", "cut_off", "images"});

inline constexpr auto kMirror = std::to_array<std::string_view>({"point", "normal"});

inline constexpr auto kSymmetryRotation =
    std::to_array<std::string_view>({"axis", "point", "folds"});

inline constexpr auto kCamera = std::to_array<std::string_view>(
    {"position", "look_at", "direction", "up", "vertical_fov_deg", "focal_length", "film"});

inline constexpr auto kGrid = std::to_array<std::string_view>(
    {"name", "surface", "offset", "corner", "sides", "points", "normals", "spacing", "border", "up",
     "cylindrical", "vertical", "semi_cylindrical", "luminance_from", "required"});

inline constexpr auto kRequired = std::to_array<std::string_view>({"Em", "U0", "Ud", "UGR"});

inline constexpr auto kObserver =
    std::to_array<std::string_view>({"name", "position", "look_at", "direction", "up", "UGR"});

}  // namespace io::keys
