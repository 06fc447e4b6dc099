#include "radiosity/solve/quantity.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <charconv>

#include "radiosity/base/error.h"
#include "radiosity/scene/color_matching.h"

namespace radiosity {
namespace {

constexpr bool kBanded = false;
constexpr bool kPhotometric = true;
constexpr bool kIntensity = false;
constexpr bool kAdditive = true;

using enum Quantity;
constexpr std::array kInfos = {
    QuantityInfo{radiance, "radiance", "radiance", "W/(m² sr)", kBanded, kIntensity},
    QuantityInfo{radiosity, "radiosity", "radiosity", "W/m²", kBanded, kIntensity},
    QuantityInfo{irradiance, "irradiance", "irradiance", "W/m²", kBanded, kIntensity},
    QuantityInfo{exitance, "exitance", "exitance", "W/m²", kBanded, kIntensity},
    QuantityInfo{incident, "incident", "incident", "W/m²", kBanded, kIntensity},
    QuantityInfo{absorbed, "absorbed", "absorbed", "W/m²", kBanded, kIntensity},
    QuantityInfo{net_flux, "net-flux", "net_flux", "W/m²", kBanded, kIntensity},
    QuantityInfo{power, "power", "power", "W", kBanded, kAdditive},
    QuantityInfo{reflectance, "reflectance", "reflectance", "", kBanded, kIntensity},
    QuantityInfo{error, "error", "radiosity_error", "W/m²", kBanded, kIntensity},
    QuantityInfo{temperature, "temperature", "surface_temperature", "K", kBanded, kIntensity},
    QuantityInfo{luminance, "luminance", "luminance", "cd/m²", kPhotometric, kIntensity},
    QuantityInfo{illuminance, "illuminance", "illuminance", "lux", kPhotometric, kIntensity},
    QuantityInfo{luminous_exitance, "luminous-exitance", "luminous_exitance", "lm/m²", kPhotometric,
                 kIntensity},
    QuantityInfo{luminous_flux, "luminous-flux", "luminous_flux", "lm", kPhotometric, kAdditive}};

/// In the shortest digits that tell the number apart.
std::string number_text(double number) {
  std::array<char, 512> text{};
  const auto end =
      std::to_chars(text.data(), text.data() + text.size(), number, std::chars_format::fixed).ptr;
  return {text.data(), end};
}

/// "below 4 µm", "4 to 8 µm", "above 8 µm"; "all" of a single band.
std::vector<std::string> thermal_names(const std::vector<double>& edges) {
  if (edges.empty()) return {"all"};
  std::vector<std::string> names = {"below " + number_text(edges.front()) + " µm"};
  for (std::size_t k = 1; k < edges.size(); ++k) {
    names.push_back(number_text(edges[k - 1]) + " to " + number_text(edges[k]) + " µm");
  }
  names.push_back("above " + number_text(edges.back()) + " µm");
  return names;
}

Eigen::MatrixXd times_area(const Eigen::MatrixXd& values, const PatchMesh& mesh) {
  return Eigen::Map<const Eigen::VectorXd>(mesh.area.data(), mesh.size()).asDiagonal() * values;
}

/// The quantity per band; of a photometric one the radiometric quantity that it weights.
Eigen::MatrixXd band_values(Quantity quantity, const PatchMesh& mesh, const Solution& solution) {
  switch (quantity) {
    case radiance:
    case luminance:
      return solution.radiosity / kPi;
    case radiosity:
    case luminous_exitance:
      return solution.radiosity;
    case irradiance:
    case illuminance:
      return solution.irradiance;
    case exitance:
      return solution.exitance;
    case incident:
      if (solution.incident.size() > 0) return solution.incident;
      return Eigen::MatrixXd::Zero(solution.radiosity.rows(), solution.radiosity.cols());
    case absorbed:
      return solution.absorbed_flux();
    case net_flux:
      return solution.net_flux();
    case power:
    case luminous_flux:
      return times_area(solution.radiosity, mesh);
    case reflectance:
      return solution.reflectance;
    case error:
      return solution.radiosity_error;
    case temperature:
      if (solution.temperature.size() > 0) return solution.temperature;
      throw SolveError("temperatures are known only where the light is heat in one grey band");
  }
  return {};
}

}  // namespace

std::span<const QuantityInfo> quantity_infos() { return kInfos; }

const QuantityInfo& quantity_info(Quantity quantity) {
  const QuantityInfo& info = kInfos[static_cast<std::size_t>(quantity)];
  assert(info.quantity == quantity);
  return info;
}

std::optional<Quantity> quantity_named(std::string_view name) {
  const auto* found = std::find_if(kInfos.begin(), kInfos.end(),
                                   [&](const QuantityInfo& info) { return info.name == name; });
  return found == kInfos.end() ? std::nullopt : std::optional(found->quantity);
}

std::vector<std::string> band_names(const Bands& bands) {
  switch (bands.kind) {
    case Bands::Kind::grey:
      return {"grey"};
    case Bands::Kind::rgb:
      return {"red", "green", "blue"};
    case Bands::Kind::solar_infrared:
      return {"solar", "infrared"};
    case Bands::Kind::thermal:
      return thermal_names(bands.edges);
    case Bands::Kind::wavelengths:
      break;
  }
  std::vector<std::string> names;
  for (const double wavelength : bands.wavelengths)
    names.push_back(number_text(wavelength) + " nm");
  return names;
}

std::string band_unit(std::string_view unit, const Bands& bands) {
  const std::string text(unit);
  if (bands.kind != Bands::Kind::wavelengths || text.empty()) return text;
  if (text.back() == ')') return text.substr(0, text.size() - 1) + " nm)";
  const auto denominator = text.find('/') + 1;
  if (denominator == 0) return text + "/nm";
  return text.substr(0, denominator) + "(" + text.substr(denominator) + " nm)";
}

Eigen::VectorXd luminous_weights(const Bands& bands, double efficacy) {
  switch (bands.kind) {
    case Bands::Kind::grey:
      return Eigen::VectorXd::Constant(1, efficacy);
    case Bands::Kind::rgb:
      return efficacy * kSrgbLuminance;
    case Bands::Kind::solar_infrared:
    case Bands::Kind::thermal:
      return Eigen::VectorXd::Zero(bands.count());
    case Bands::Kind::wavelengths:
      break;
  }
  return kPeakEfficacy * tristimulus_weights(bands.wavelengths).col(1);
}

Eigen::VectorXd mean_over_bands(const Eigen::MatrixXd& values,
                                const std::vector<double>& wavelengths) {
  if (wavelengths.size() < 2) return values.rowwise().mean();
  const Eigen::VectorXd weights = integration_weights(wavelengths);
  assert(values.cols() == weights.size());
  return values * weights / weights.sum();
}

QuantityField make_field(Quantity quantity, const PatchMesh& mesh, const Solution& solution,
                         const Bands& bands, double efficacy) {
  const QuantityInfo& info = quantity_info(quantity);
  QuantityField field = {info, std::string(info.unit), band_values(quantity, mesh, solution)};
  if (info.is_photometric) {
    field.values = (field.values * luminous_weights(bands, efficacy)).eval();
  } else {
    field.unit = band_unit(info.unit, bands);
  }
  return field;
}

}  // namespace radiosity
