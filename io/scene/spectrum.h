#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace io {

/// A quantity by wavelength.
struct Spectrum {
  std::vector<double> wavelengths;  ///< nm, increasing, at least one
  std::vector<double> values;
};

/// Reads a column of a CSV file: comments (#), a line of column names of which the first is
/// `wavelength_nm`, then numbers. `check` says what is wrong with a value, if anything. Throws
/// SceneError with file and line.
Spectrum read_spectrum(const std::filesystem::path& path, const std::string& column,
                       const std::function<std::optional<std::string>(double)>& check);

/// The spectrum's values, linear between its wavelengths, at other wavelengths (nm) that must lie
/// within its range.
Eigen::VectorXd interpolate(const Spectrum& spectrum, const std::vector<double>& wavelengths);

}  // namespace io
