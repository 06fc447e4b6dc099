#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/validation/cases/case.h"
#include "radiosity/base/geometry.h"

namespace apps::validation {

/// A point of CIE 171's rooms that is measured, with its surface's unit normal.
struct RoomPoint {
  radiosity::Vec3 position;  ///< m
  radiosity::Vec3 normal;
};

/// Points half a metre apart in the plane x = 2 of a room of 4 x 4 x 3 m: n of them.
std::vector<RoomPoint> wall_points(double y, bool faces_up_y, double highest, int n);
std::vector<RoomPoint> level_points(double z, bool faces_up, int n);

/// The same points of a scene turned by the angle about z (radian), then moved.
std::vector<RoomPoint> moved(std::vector<RoomPoint> points, double angle,
                             const radiosity::Vec3& step);

/// Values of tests/data/cie171-exact.json at the keys inside each other, one per point. Throws
/// SceneError naming the file and the key that is not there.
std::vector<double> exact_values(const std::filesystem::path& data,
                                 const std::vector<std::string>& keys);

/// What came of a row of points: how far it is off at most, and a row of the table.
void add_exact(CaseResult& result, Table& table, const std::string& name,
               const std::vector<double>& computed, const std::vector<double>& exact, int digits,
               const std::string& unit);

}  // namespace apps::validation
