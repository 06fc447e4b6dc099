#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "radiosity/picture/measured_grid.h"
#include "viewer/desk/isolines.h"
#include "viewer/desk/legend.h"
#include "viewer/desk/look.h"

namespace viewer {

/// A work plane as it is drawn: of cells whose point is measured, the others are holes.
struct PlanePicture {
  std::vector<radiosity::Vec3> points;  ///< m
  std::vector<std::array<std::int32_t, 3>> triangles;
  std::vector<float> positions;  ///< per point, on the legend's colour map
  std::vector<SurfaceLine> lines;
  std::vector<IsoNumber> numbers;  ///< on isolines or, if the look has numbers, at the points
  Legend legend;
};

/// What is told beside the colour bar of a plane.
struct PlaneWords {
  std::string unit;  ///< of its values
  std::string note = {};
  std::string title = "work plane";
};

/// Colours values (one per point of the grid) on the scale of the look: blended between the points
/// if it is smooth, with isolines if it has these.
PlanePicture plane_picture(const radiosity::MeasuredGrid& measured, const Eigen::VectorXd& values,
                           const PlaneWords& words, const Look& look);

}  // namespace viewer
