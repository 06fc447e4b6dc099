#include "radiosity/solve/quantity.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <charconv>

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
    QuantityInfo{net_flux, "net-flux", "net_flux", "W/m²", kBanded, kIntensity},
    QuantityInfo{power, "power", "power", "W", kBanded, kAdditive},
    QuantityInfo{reflectance, "reflectance", "reflectance", "", kBanded, kIntensity},
    QuantityInfo{error, "error", "radiosity_error", "W/m²", kBanded, kIntensity},
    QuantityInfo{luminance, "luminance", "luminance", "cd/m²", kPhotometric, kIntensity},
    QuantityInfo{illuminance, "illuminance", "illuminance", "lux", kPhotometric, kIntensity},
    QuantityInfo{luminous_exitance, "luminous-exitance", "luminous_exitance", "lm/m²", kPhotometric,
                 kIntensity},
    QuantityInfo{luminous_flux, "luminous-flux", "luminous_flux", "lm", kPhotometric, kAdditive}};

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
    case net_flux:
      return solution.net_flux();
    case power:
    case luminous_flux:
      return times_area(solution.radiosity, mesh);
    case reflectance:
      return solution.reflectance;
    case error:
      return solution.radiosity_error;
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
    case Bands::Kind::wavelengths:
      break;
  }
  std::vector<std::string> names;
  for (const double wavelength : bands.wavelengths) {
    std::array<char, 512> text{};  // holds any number in the shortest digits that tell it apart
    const auto end =
        std::to_chars(text.data(), text.data() + text.size(), wavelength, std::chars_format::fixed)
            .ptr;
    names.push_back(std::string(text.data(), end) + " nm");
  }
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
