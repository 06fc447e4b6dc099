#include "viewer/desk/plane_picture.h"

#include <algorithm>
#include <cmath>

#include "viewer/desk/hidden_surfaces.h"
#include "viewer/desk/shown_scale.h"

namespace viewer {
namespace {

using radiosity::Index;
using radiosity::PointGrid;
using radiosity::PointPlace;
using radiosity::Vec3;

constexpr double kPlaneMapEnd = 0.002;  // as patches
constexpr int kMostPlaneTicks = 11;
constexpr double kIsoNumberSpacing = 0.3;  // of the plane's size
constexpr double kNumberDigits = 3;

bool is_open(const radiosity::MeasuredGrid& measured, Index row, Index column) {
  const PointGrid& grid = measured.grid;
  if (row < 0 || column < 0 || row >= grid.n_rows || column >= grid.n_columns) return false;
  const Index k = row * grid.n_columns + column;
  return measured.places[static_cast<std::size_t>(k)] == PointPlace::open;
}

Eigen::VectorXd open_values(const radiosity::MeasuredGrid& measured,
                            const Eigen::VectorXd& values) {
  std::vector<double> kept;
  for (Index k = 0; k < values.size(); ++k) {
    if (measured.places[static_cast<std::size_t>(k)] == PointPlace::open) kept.push_back(values[k]);
  }
  return Eigen::Map<const Eigen::VectorXd>(kept.data(), static_cast<Index>(kept.size()));
}

/// The mean of the cells about a corner of the grid that are measured; one of them is.
double corner_value(const radiosity::MeasuredGrid& measured, const Eigen::VectorXd& values,
                    Index row, Index column) {
  double sum = 0;
  int n = 0;
  for (const Index r : {row - 1, row}) {
    for (const Index c : {column - 1, column}) {
      if (!is_open(measured, r, c)) continue;
      sum += values[r * measured.grid.n_columns + c];
      ++n;
    }
  }
  return sum / n;
}

/// Four triangles about the middle of each cell, which has a value of its own and of its corners.
void add_cells(const radiosity::MeasuredGrid& measured, const Eigen::VectorXd& values,
               bool is_blended, PlanePicture& picture) {
  const PointGrid& grid = measured.grid;
  const auto position = [&](double value) {
    return static_cast<float>(
        std::clamp(io::position_on(picture.legend.scale, value), kPlaneMapEnd, 1 - kPlaneMapEnd));
  };
  for (Index row = 0; row < grid.n_rows; ++row) {
    for (Index column = 0; column < grid.n_columns; ++column) {
      if (!is_open(measured, row, column)) continue;
      const auto first = static_cast<std::int32_t>(picture.points.size());
      const Index k = row * grid.n_columns + column;
      picture.points.push_back(grid.point(k));
      picture.positions.push_back(position(values[k]));
      constexpr std::array<std::array<Index, 2>, 4> kCorners = {{{0, 0}, {0, 1}, {1, 1}, {1, 0}}};
      for (const auto& [up, right] : kCorners) {
        picture.points.push_back(grid.corner + static_cast<double>(column + right) * grid.column +
                                 static_cast<double>(row + up) * grid.row);
        const double value =
            is_blended ? corner_value(measured, values, row + up, column + right) : values[k];
        picture.positions.push_back(position(value));
      }
      for (std::int32_t c = 0; c < 4; ++c) {
        picture.triangles.push_back({first, first + 1 + c, first + 1 + (c + 1) % 4});
      }
    }
  }
}

Legend plane_legend(const Eigen::VectorXd& values, const PlaneWords& words, const Look& look) {
  Legend legend;
  legend.scale = shown_scale(look, values);
  legend.title = {words.title, words.unit};
  if (const std::string scale = scale_note(look, legend.scale); !scale.empty()) {
    legend.title.push_back(scale);
  }
  if (!words.note.empty()) legend.title.push_back(words.note);
  legend.unit = words.unit;
  legend.map = look.map;
  legend.ticks = legend_ticks(look, legend.scale, kMostPlaneTicks);
  legend.fit = fit_text(look);
  if (values.size() > 0) {
    legend.least = values.minCoeff();
    legend.greatest = values.maxCoeff();
  }
  legend.has_below = legend.least < legend.scale.low;
  legend.has_above = legend.greatest > legend.scale.high;
  return legend;
}

void add_isolines(const PointGrid& grid, const Look& look, PlanePicture& picture) {
  const std::vector<std::int32_t> surfaces(picture.triangles.size(), 0);
  const double size = (static_cast<double>(grid.n_columns) * grid.column +
                       static_cast<double>(grid.n_rows) * grid.row)
                          .norm();
  const BlendedTriangles field = {picture.points, picture.triangles, surfaces, picture.positions};
  Isolines isolines = make_isolines(field, iso_levels(picture.legend), look.map, HiddenSurfaces{},
                                    kIsoNumberSpacing * size);
  for (SurfaceLine& line : isolines.lines)
    line.normals[1] = -line.normals[0];  // seen from below, too
  picture.lines = std::move(isolines.lines);
  picture.numbers = std::move(isolines.numbers);
}

/// In as many digits as a person reads.
double rounded(double value) {
  if (value == 0 || !std::isfinite(value)) return value;
  const double unit = std::pow(10, std::floor(std::log10(std::abs(value))) + 1 - kNumberDigits);
  return unit * std::round(value / unit);
}

}  // namespace

PlanePicture plane_picture(const radiosity::MeasuredGrid& measured, const Eigen::VectorXd& values,
                           const PlaneWords& words, const Look& look) {
  PlanePicture picture;
  picture.legend = plane_legend(open_values(measured, values), words, look);
  add_cells(measured, values, look.smooth, picture);
  if (look.isolines && look.smooth) add_isolines(measured.grid, look, picture);
  if (!look.numbers) return picture;
  picture.numbers.clear();
  for (Index k = 0; k < measured.grid.size(); ++k) {
    if (measured.places[static_cast<std::size_t>(k)] != PointPlace::open) continue;
    picture.numbers.push_back({rounded(values[k]), measured.grid.point(k)});
  }
  return picture;
}

}  // namespace viewer
