#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "radiosity/base/geometry.h"

class vtkPolyData;

namespace io {

/// The arrays of a polydata that came from a file, checked as they are taken: all functions throw
/// SceneError naming the file and the array if one is not there or not as asked for.
class PolydataArrays {
 public:
  /// Whole numbers that an array may hold, `low` to `high`.
  struct Range {
    std::int64_t low;
    std::int64_t high;
  };

  /// `polydata` must outlive the arrays.
  PolydataArrays(vtkPolyData& polydata, std::filesystem::path path)
      : polydata_(polydata), path_(std::move(path)) {}

  [[nodiscard]] bool has_cell_array(const char* name) const;
  [[nodiscard]] bool has_field(const char* name) const;

  /// Points, m, finite.
  [[nodiscard]] std::vector<radiosity::Vec3> points() const;
  /// Corners of each cell, all of which must be triangles or quads ([3] = -1 for a triangle).
  [[nodiscard]] std::vector<std::array<std::int32_t, 4>> corners() const;
  /// A cell array, one row per cell; finite.
  [[nodiscard]] Eigen::MatrixXd cell_values(const char* name) const;
  /// A cell array of one whole number per cell.
  [[nodiscard]] std::vector<std::int32_t> cell_integers(const char* name, Range range) const;

  /// Field data of any length; nothing if there are none of the name. Not NaN.
  [[nodiscard]] std::optional<std::vector<double>> field_values(const char* name) const;
  [[nodiscard]] std::optional<std::vector<std::int32_t>> field_integers(const char* name,
                                                                        Range range) const;
  [[nodiscard]] std::optional<std::vector<std::string>> field_texts(const char* name) const;

 private:
  vtkPolyData& polydata_;
  std::filesystem::path path_;
};

}  // namespace io
