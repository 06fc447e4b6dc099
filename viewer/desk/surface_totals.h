#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "radiosity/base/geometry.h"
#include "radiosity/scene/patch_mesh.h"
#include "viewer/work/known.h"
#include "viewer/work/session.h"

namespace viewer {

/// What a surface has as a whole.
struct SurfaceTotal {
  std::int32_t surface = 0;
  std::string name;
  std::string material = {};  ///< "" without a scene
  radiosity::Index n_patches = 0;
  double area = 0;  ///< m², both sides of a two-sided surface
  /// Of what leaves, Σ A B, and of what arrives, the mean over the area; lm and lux or, in thermal
  /// scenes, W and W/m² over all bands. Absent without light.
  std::optional<double> flux = {};
  std::optional<double> irradiance = {};
  std::optional<double> heat = {};         ///< Σ A (B − H), W; of thermal scenes
  std::optional<double> temperature = {};  ///< K, of what radiates by it
};

/// K, of a surface that radiates by its temperature, as the mix has it; empty for others.
std::optional<double> surface_temperature(const Session& session, std::int32_t surface);
double celsius(double kelvin);
/// "400.0 K, 126.9 °C".
std::string temperature_text(double kelvin);

/// One entry per surface, in the scene's order; none if no scene is open. Takes as many additions
/// as there are patches.
std::vector<SurfaceTotal> surface_totals(const Known& known);
/// The same with temperatures, as the mix has them.
std::vector<SurfaceTotal> surface_totals(const Session& session);
void set_temperatures(std::vector<SurfaceTotal>& totals, const Session& session);

/// By what a list of surfaces is sorted.
enum class TotalColumn { name, area, flux, irradiance, heat, temperature };
struct TotalOrder {
  TotalColumn column = TotalColumn::name;
  bool is_falling = false;
};
/// "name", "area", "flux", "irradiance", "heat", "temperature"; empty for anything else.
std::optional<TotalColumn> total_column_named(std::string_view name);
/// Sorts; what is alike stays as it was, and what is absent comes last.
void sort(std::vector<SurfaceTotal>& totals, const TotalOrder& order);

/// The surface of that name, or whose index it is; empty if there is none.
std::optional<std::int32_t> surface_named(const radiosity::PatchMesh& mesh,
                                          const std::string& name);

}  // namespace viewer
