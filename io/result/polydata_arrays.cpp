#include "io/result/polydata_arrays.h"

#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>

#include <cmath>
#include <limits>

#include "io/base/line_reader.h"

namespace io {
namespace {

using radiosity::Index;
using radiosity::Vec3;

std::int32_t integer(double value, const char* name, Index item, PolydataArrays::Range range,
                     const std::filesystem::path& path) {
  if (!(value >= static_cast<double>(range.low) && value <= static_cast<double>(range.high)) ||
      value != std::floor(value)) {
    fail(path, fmt::format("array \"{}\" has {} at {}, expected a whole number from {} to {}", name,
                           value, item, range.low, range.high));
  }
  return static_cast<std::int32_t>(value);
}

/// The values of offsets or connectivity, whichever width the file has them in.
std::vector<std::int64_t> copy(vtkCellArray& cells, bool are_offsets) {
  std::vector<std::int64_t> values;
  const auto append = [&](auto* array) {
    const auto* first = array->GetPointer(0);
    values.assign(first, first + array->GetNumberOfValues());
  };
  if (cells.IsStorage64Bit()) {
    append(are_offsets ? cells.GetOffsetsArray64() : cells.GetConnectivityArray64());
  } else {
    append(are_offsets ? cells.GetOffsetsArray32() : cells.GetConnectivityArray32());
  }
  return values;
}

}  // namespace

bool PolydataArrays::has_cell_array(const char* name) const {
  return polydata_.GetCellData()->GetArray(name) != nullptr;
}

bool PolydataArrays::has_field(const char* name) const {
  return polydata_.GetFieldData()->GetAbstractArray(name) != nullptr;
}

std::vector<Vec3> PolydataArrays::points() const {
  std::vector<Vec3> points;
  vtkPoints* stored = polydata_.GetPoints();
  if (stored == nullptr || stored->GetNumberOfPoints() == 0) fail(path_, "has no points");
  points.resize(static_cast<std::size_t>(stored->GetNumberOfPoints()));
  for (std::size_t i = 0; i < points.size(); ++i) {
    stored->GetPoint(static_cast<vtkIdType>(i), points[i].data());
    if (!points[i].allFinite()) fail(path_, fmt::format("point {} is not finite", i));
  }
  return points;
}

std::vector<std::array<std::int32_t, 4>> PolydataArrays::corners() const {
  vtkCellArray& polygons = *polydata_.GetPolys();
  const auto offsets = copy(polygons, true);
  const auto connectivity = copy(polygons, false);
  if (offsets.size() < 2) fail(path_, "has no polygons");
  if (polydata_.GetNumberOfCells() != static_cast<vtkIdType>(offsets.size()) - 1) {
    fail(path_, "has vertices, lines or strips beside its polygons, expected patches only");
  }
  const vtkIdType n_points = polydata_.GetNumberOfPoints();
  std::vector<std::array<std::int32_t, 4>> corners;
  for (std::size_t i = 0; i + 1 < offsets.size(); ++i) {
    // Compared without a difference, which the file's numbers could make overflow.
    const bool is_inside = offsets[i] >= 0 && offsets[i + 1] >= offsets[i] &&
                           offsets[i + 1] <= static_cast<std::int64_t>(connectivity.size());
    if (!is_inside) fail(path_, fmt::format("polygon {} lies outside the list of corners", i));
    const std::int64_t n = offsets[i + 1] - offsets[i];
    if (n != 3 && n != 4) {
      fail(path_, fmt::format("polygon {} has {} corners, expected 3 or 4", i, n));
    }
    std::array<std::int32_t, 4> patch = {-1, -1, -1, -1};
    for (std::int64_t k = 0; k < n; ++k) {
      const std::int64_t corner = connectivity[offsets[i] + k];
      if (corner < 0 || corner >= n_points || corner > std::numeric_limits<std::int32_t>::max()) {
        fail(path_,
             fmt::format("polygon {} uses point {}, but the file has {}", i, corner, n_points));
      }
      patch[k] = static_cast<std::int32_t>(corner);
    }
    corners.push_back(patch);
  }
  return corners;
}

Eigen::MatrixXd PolydataArrays::cell_values(const char* name) const {
  vtkDataArray* array = polydata_.GetCellData()->GetArray(name);
  if (array == nullptr) fail(path_, fmt::format("has no array \"{}\"", name));
  const vtkIdType n = polydata_.GetNumberOfCells();
  if (array->GetNumberOfTuples() != n) {
    fail(path_, fmt::format("array \"{}\" has {} rows, but there are {} patches", name,
                            array->GetNumberOfTuples(), n));
  }
  Eigen::MatrixXd values(n, array->GetNumberOfComponents());
  Eigen::VectorXd row(values.cols());
  for (vtkIdType i = 0; i < n; ++i) {
    array->GetTuple(i, row.data());
    if (!row.allFinite()) {
      fail(path_, fmt::format("array \"{}\" has a value that is not finite at patch {}", name, i));
    }
    values.row(i) = row;
  }
  return values;
}

std::vector<std::int32_t> PolydataArrays::cell_integers(const char* name, Range range) const {
  const Eigen::MatrixXd values = cell_values(name);
  if (values.cols() != 1) {
    fail(path_, fmt::format("array \"{}\" has {} columns, expected 1", name, values.cols()));
  }
  std::vector<std::int32_t> result;
  for (Index i = 0; i < values.rows(); ++i) {
    result.push_back(integer(values(i, 0), name, i, range, path_));
  }
  return result;
}

std::optional<std::vector<double>> PolydataArrays::field_values(const char* name) const {
  vtkDataArray* array = polydata_.GetFieldData()->GetArray(name);
  if (array == nullptr) return std::nullopt;
  std::vector<double> values;
  for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i) {
    for (int k = 0; k < array->GetNumberOfComponents(); ++k) {
      values.push_back(array->GetComponent(i, k));
      if (std::isnan(values.back())) fail(path_, fmt::format("array \"{}\" has a NaN", name));
    }
  }
  return values;
}

std::optional<std::vector<std::int32_t>> PolydataArrays::field_integers(const char* name,
                                                                        Range range) const {
  const auto values = field_values(name);
  if (!values) return std::nullopt;
  std::vector<std::int32_t> result;
  for (const double value : *values) {
    result.push_back(integer(value, name, static_cast<Index>(result.size()), range, path_));
  }
  return result;
}

std::optional<std::vector<std::string>> PolydataArrays::field_texts(const char* name) const {
  auto* array = vtkStringArray::SafeDownCast(polydata_.GetFieldData()->GetAbstractArray(name));
  if (array == nullptr) return std::nullopt;
  std::vector<std::string> texts;
  for (vtkIdType i = 0; i < array->GetNumberOfValues(); ++i) texts.push_back(array->GetValue(i));
  return texts;
}

}  // namespace io
