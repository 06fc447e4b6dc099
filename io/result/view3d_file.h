#pragma once

#include <Eigen/Core>
#include <filesystem>

namespace io {

/// What View3D tells of surfaces.
struct View3dTable {
  Eigen::VectorXd areas;         ///< m²
  Eigen::MatrixXd factors;       ///< F_ij, a row per surface
  Eigen::VectorXd emissivities;  ///< per surface
  bool is_enclosure = true;      ///< no radiation leaves the surfaces
};

struct View3dOptions {
  /// ε_i B_ij with Gebhart's factors B = (I - F R)⁻¹ F E (Gebhart 1961) in place of F_ij.
  bool is_script_f = false;
  bool is_binary = false;
};

/// Writes form factors between surfaces as View3D 4 does into its files. Text: a header, the areas,
/// a row of factors for each surface with six decimals, and the emissivities, one per surface, with
/// three. Binary: a header of 32 bytes, then the same numbers as float32, least byte first.
/// Emissivities are kept between 0.001 and 0.999, as there. Throws OutputError.
void write_view3d(const std::filesystem::path& path, const View3dTable& table,
                  const View3dOptions& options = {});

}  // namespace io
