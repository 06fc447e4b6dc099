#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "io/result/vtp_file.h"
#include "radiosity/scene/scene.h"

namespace io {

/// What the cells of a VTK file say of their materials: `reflectance` or `emissivity` (1 minus it),
/// and `exitance` (W/m²), `radiance` (W/(m² sr)) or `temperature` (K). Those have a column for each
/// band, or one for all; `emissivity` and `temperature` have one. Of a result that `io::write` made
/// only its reflectance and exitance count.
class VtkCellMaterials {
 public:
  /// `file` must outlive this. Throws SceneError naming `path` if arrays contradict each other.
  VtkCellMaterials(const VtpFile& file, const std::filesystem::path& path);

  /// Whether there are any.
  [[nodiscard]] bool empty() const { return reflectance_ == nullptr; }
  /// What was left out of the file, if anything.
  [[nodiscard]] const std::string& left_out() const { return left_out_; }

  /// Adds the cell's material to the scene, unless it is there, and returns its index; -1 if the
  /// file has none. Throws SceneError if a value is impossible. `scene` is the same at each call.
  int find_or_add(std::size_t cell, radiosity::Scene& scene);
  /// Those of the columns.
  [[nodiscard]] const radiosity::Bands& bands() const { return bands_; }

 private:
  [[nodiscard]] const VtpArray* of_cells(const char* name) const;
  void find_bands();
  [[nodiscard]] Eigen::VectorXd values(const VtpArray& array, std::size_t cell) const;

  const VtpFile& file_;
  const std::filesystem::path& path_;
  const VtpArray* reflectance_ = nullptr;
  bool is_emissivity_ = false;
  const VtpArray* emission_ = nullptr;
  std::string emission_name_;
  radiosity::Emission::Kind kind_ = radiosity::Emission::Kind::none;
  radiosity::Bands bands_;
  std::string left_out_;
  std::map<std::vector<double>, int> known_;  // by what there is of a cell
};

}  // namespace io
