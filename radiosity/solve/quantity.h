#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "radiosity/scene/patch_mesh.h"
#include "radiosity/scene/scene.h"
#include "radiosity/solve/solution.h"

namespace radiosity {

/// What can be told of every patch of a solution: radiometric quantities for each band, and
/// photometric ones, a single value per patch.
enum class Quantity {
  radiance,           ///< L = B / π
  radiosity,          ///< B = M_e + ρ H, what leaves by emission and reflection
  irradiance,         ///< H, what arrives
  exitance,           ///< M_e, what is emitted
  incident,           ///< H_0, direct irradiance of sun and environment, a part of H
  absorbed,           ///< (1 - ρ - T) H
  net_flux,           ///< B - H
  power,              ///< A B, what leaves the patch
  reflectance,        ///< ρ
  error,              ///< one standard error of B
  temperature,        ///< what patches are at, K; of one grey band of heat only
  luminance,          ///< of L
  illuminance,        ///< of H
  luminous_exitance,  ///< of B: all light that leaves, as photometry uses the word
  luminous_flux       ///< of A B
};

/// How a quantity is called and measured.
struct QuantityInfo {
  Quantity quantity;
  std::string_view name;    ///< on the command line: "net-flux"
  std::string_view column;  ///< in files: "net_flux"
  std::string_view unit;    ///< per band, wherever a band is no density; "" for a plain number
  bool is_photometric;      ///< one value per patch, weighted by the eye's sensitivity
  bool is_additive;         ///< belongs to a whole patch, so that surfaces have the sum; else the
                            ///< mean over their area
};

/// All quantities, in the order of the enumeration.
std::span<const QuantityInfo> quantity_infos();
const QuantityInfo& quantity_info(Quantity quantity);
/// Empty if no quantity has that name.
std::optional<Quantity> quantity_named(std::string_view name);

/// The unit of a band's values: as given, but per nm if the bands are wavelengths.
std::string band_unit(std::string_view unit, const Bands& bands);

/// "grey"; "red", "green", "blue"; "400 nm"...; "solar", "infrared"; or "below 4 µm"...
std::vector<std::string> band_names(const Bands& bands);

/// lm/W of white light, by which RGB and grey bands become photometric: a convention of lighting
/// simulation (Radiance's WHTEFFICACY), not a measured value of any lamp.
inline constexpr double kWhiteEfficacy = 179;
/// Luminous efficacy at the peak of V(λ), 683 lm/W (SI; strictly of radiation of 540 THz).
inline constexpr double kPeakEfficacy = 683;

/// Weights of the bands in the photometric counterpart of a quantity, lm/W: X_v = Σ_b w_b X_b.
/// Wavelengths: 683 lm/W ∫ V(λ) X_λ dλ by the trapezoidal rule, with V = ȳ of the CIE 1931
/// observer, 0 outside 360..830 nm; 0 for a single wavelength, which spans nothing. RGB: `efficacy`
/// times 0.2126, 0.7152, 0.0722 (linear sRGB, Rec. 709). Grey: `efficacy`. Bands of heat: 0.
Eigen::VectorXd luminous_weights(const Bands& bands, double efficacy = kWhiteEfficacy);

/// The mean over bands: with wavelengths (nm, increasing, one per band) that over their range
/// (trapezoidal rule), without or with one only of all bands alike. `values` is n x n_bands, the
/// result has n entries.
Eigen::VectorXd mean_over_bands(const Eigen::MatrixXd& values,
                                const std::vector<double>& wavelengths);

/// A quantity on every patch.
struct QuantityField {
  QuantityInfo info;
  std::string unit;        ///< with the bands' density reckoned in
  Eigen::MatrixXd values;  ///< n_patches x n_bands; x 1 if photometric
};

/// Throws SolveError for temperatures of a solution that has none.
QuantityField make_field(Quantity quantity, const PatchMesh& mesh, const Solution& solution,
                         const Bands& bands, double efficacy = kWhiteEfficacy);

}  // namespace radiosity
