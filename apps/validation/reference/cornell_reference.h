#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "radiosity/base/geometry.h"

namespace apps::validation {

/// A row of reference-radiosity-8x8.csv: a polygon of the Cornell box, path traced.
struct ReferencePolygon {
  std::string surface;
  std::vector<radiosity::Vec3> corners{};  ///< mm
  double area = 0;                         ///< mm²
  Eigen::Array3d radiosity{};              ///< R, G, B; W/m²
  Eigen::Array3d standard_error{};         ///< of these
};

/// Reads the reference in the folder of reference data, in the order of patches-8x8.obj. Throws
/// SceneError naming the file and the line if it is missing or not as expected.
std::vector<ReferencePolygon> read_cornell_reference(const std::filesystem::path& data);

/// Polygons that the reference itself contradicts, by index: radiosity 0 in all bands, although
/// every neighbour (same surface, two corners in common) has at least half the mean radiosity of
/// the surface. What lies under a block has dark neighbours, too.
std::vector<std::size_t> defective_polygons(const std::vector<ReferencePolygon>& reference);

/// Mean radiosity of the surface by area, bands added up, W/m².
double surface_radiosity(const std::vector<ReferencePolygon>& reference,
                         const std::string& surface);

}  // namespace apps::validation
