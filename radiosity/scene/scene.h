#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "radiosity/base/geometry.h"
#include "radiosity/scene/given_heat.h"
#include "radiosity/scene/glazing.h"
#include "radiosity/scene/light_plan.h"
#include "radiosity/scene/luminaire.h"
#include "radiosity/scene/photometry.h"
#include "radiosity/scene/sky.h"
#include "radiosity/scene/sun.h"
#include "radiosity/scene/symmetry.h"
#include "radiosity/scene/texture.h"

namespace radiosity {

/// The spectral bands of a scene: one grey band, linear RGB, or a list of wavelengths; of heat the
/// sun's light and infrared, or grey bands between wavelengths.
struct Bands {
  enum class Kind { grey, rgb, wavelengths, solar_infrared, thermal };
  Kind kind = Kind::rgb;
  std::vector<double> wavelengths;  ///< nm, increasing; used by Kind::wavelengths only
  /// µm, increasing: between the bands of Kind::thermal; of Kind::solar_infrared the wavelength
  /// that parts them, or none: then all that surfaces emit is infrared.
  std::vector<double> edges = {};

  /// Number of bands, >= 1.
  [[nodiscard]] Index count() const {
    switch (kind) {
      case Kind::grey:
        return 1;
      case Kind::rgb:
        return 3;
      case Kind::solar_infrared:
        return 2;
      case Kind::thermal:
        return static_cast<Index>(edges.size()) + 1;
      case Kind::wavelengths:
        break;
    }
    return static_cast<Index>(wavelengths.size());
  }
  /// Whether the bands hold all thermal radiation, so that surfaces can emit by temperature.
  [[nodiscard]] bool hold_heat() const { return kind != Kind::rgb && kind != Kind::wavelengths; }
};

/// What a surface emits by itself. One value per band, or a single kelvin value for temperature.
struct Emission {
  enum class Kind {
    none,
    radiance,     ///< L, W/(m² sr); M_e = π L
    exitance,     ///< M_e, W/m²
    power,        ///< Φ, W, of each surface with this material; M_e = Φ / A
    temperature,  ///< T, K; M_e = ε f σ T⁴ with ε = 1 - ρ and f the bands' thermal_fractions
    heat_flux,    ///< B - H, W/m²: what is given off, whatever temperature that takes (grey band)
    heat_power    ///< the same of each surface with this material, W
  };
  Kind kind = Kind::none;
  Eigen::VectorXd value;  ///< size = number of bands; 1 for temperature; empty for none
};

/// A diffuse material. Reflectance has one value in [0, 1] per band.
struct Material {
  std::string name;
  Eigen::VectorXd reflectance;
  Emission emission;
  /// If it is a pane: what that lets through of the sun and the sky.
  std::optional<Glazing> glazing = {};
  double maintenance_factor = 1;  ///< of its lamps, (0, 1]: LightPlan
  /// Pairs of a temperature, K, and the emissivity at it, increasing, of one grey band
  /// (emissivity_at); `reflectance` is then that at the material's own temperature, or at 300 K.
  /// Empty: constant.
  std::vector<std::pair<double, double>> emissivity_table = {};
  /// What it reflects from place to place, of RGB bands; `reflectance` is then the mean.
  std::optional<Texture> texture = {};
};

/// A named set of polygons that share a material.
struct Surface {
  std::string name;
  int material = 0;        ///< index into Scene::materials
  bool two_sided = false;  ///< each polygon then gives two patches, back to back
  /// Of the power that its material emits by itself, what this surface does: >= 0; 0 = it is off.
  double emission_factor = 1;
  /// Of its backs if two-sided: index into Scene::materials; -1 = the same.
  int back_material = -1;
  /// Two-sided, its patches each of one temperature for both sides, which follows from the heat:
  /// none is given to it but what its materials say.
  bool is_shield = false;
};

/// A pinhole camera.
struct Camera {
  Vec3 position = Vec3::Zero();     ///< m
  Vec3 direction = Vec3(0, 0, -1);  ///< viewing direction, unit length
  Vec3 up = Vec3(0, 1, 0);          ///< not parallel to direction
  double vertical_fov = 0.6862;     ///< full angle, radian, in (0, π)
};

/// A camera that a person wants to come back to.
struct View {
  std::string name;
  Camera camera;
};

/// Surfaces as the user gave them, in metres: polygons of three or more vertices in file order,
/// counter-clockwise about the emitting side. Plain data; `io::read_scene` makes one and has
/// checked it (finite coordinates, indices in range, 0 <= reflectance <= 1, emission >= 0).
struct Scene {
  std::string source;       ///< file name, for messages
  std::string name;         ///< as the file has it, for people; or ""
  std::string description;  ///< likewise
  /// The file itself and all that it refers to, read or not (pictures are not): what must not be
  /// overwritten.
  std::vector<std::filesystem::path> files;
  Bands bands;
  std::vector<Vec3> vertices;
  std::vector<std::int32_t> corners;          ///< vertex indices of all polygons, concatenated
  std::vector<std::int64_t> first_corner{0};  ///< n_polygons + 1 offsets into `corners`
  std::vector<std::int32_t> polygon_surface;  ///< per polygon: index into `surfaces`
  /// Per corner: u across the picture of a texture, v down it; not finite where there is none.
  /// Empty if no polygon has any.
  std::vector<Eigen::Vector2d> texture_coordinates;
  std::vector<Surface> surfaces;
  std::vector<Material> materials;
  /// What comes in wherever a patch sees no other and no back: of radiance, exitance or temperature
  /// (of a black one).
  Emission environment;
  std::vector<GivenHeat> given_heat;  ///< of single patches or polygons
  /// How far a coordinate may be off what was meant, for its last digits were rounded away: half a
  /// unit in the last place of the file, m. 0 = exact but for the rounding of `double`.
  double precision = 0;
  std::optional<Sun> sun;
  std::vector<Photometry> photometries;  ///< of luminaires
  std::vector<Luminaire> luminaires;     ///< no two of one name
  std::optional<Sky> sky;
  std::optional<Camera> camera;
  std::vector<View> views;            ///< other cameras, no two of one name
  Symmetry symmetry;                  ///< the polygons are a part of a whole, if there is any
  std::optional<bool> closed;         ///< as declared by the user; absent = to be found out
  LightPlan light_plan;               ///< what is to be measured
  std::vector<std::string> warnings;  ///< what the reader noticed and the user should know

  [[nodiscard]] Index n_polygons() const { return static_cast<Index>(polygon_surface.size()); }

  /// Vertex indices of polygon i.
  [[nodiscard]] std::span<const std::int32_t> polygon(Index i) const {
    return std::span(corners).subspan(first_corner[i], first_corner[i + 1] - first_corner[i]);
  }

  /// Appends a polygon of `surface` with the given vertex indices.
  void add_polygon(std::span<const std::int32_t> vertex_indices, std::int32_t surface) {
    corners.insert(corners.end(), vertex_indices.begin(), vertex_indices.end());
    first_corner.push_back(static_cast<std::int64_t>(corners.size()));
    polygon_surface.push_back(surface);
  }
};

}  // namespace radiosity
