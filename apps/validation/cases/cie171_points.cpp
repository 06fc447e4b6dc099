#include "apps/validation/cases/cie171_points.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "io/base/json_item.h"
#include "radiosity/base/error.h"

namespace apps::validation {

using namespace radiosity;

namespace {

constexpr double kMiddle = 2;     // x of all points, m
constexpr double kSpacing = 0.5;  // m

std::string listed(const std::vector<double>& values, int digits) {
  std::vector<std::string> texts;
  for (const double value : values) texts.push_back(fmt::format("{:.{}f}", value, digits));
  return fmt::format("{}", fmt::join(texts, " "));
}

}  // namespace

std::vector<RoomPoint> wall_points(double y, bool faces_up_y, double highest, int n) {
  std::vector<RoomPoint> points;
  for (int k = 0; k < n; ++k) {
    points.push_back({Vec3(kMiddle, y, highest - k * kSpacing), Vec3(0, faces_up_y ? 1 : -1, 0)});
  }
  return points;
}

std::vector<RoomPoint> level_points(double z, bool faces_up, int n) {
  std::vector<RoomPoint> points;
  for (int k = 0; k < n; ++k) {
    points.push_back({Vec3(kMiddle, (k + 0.5) * kSpacing, z), Vec3(0, 0, faces_up ? 1 : -1)});
  }
  return points;
}

std::vector<RoomPoint> moved(std::vector<RoomPoint> points, double angle, const Vec3& step) {
  const Eigen::AngleAxisd turn(angle, Vec3::UnitZ());
  for (RoomPoint& point : points) {
    point.position = turn * point.position + step;
    point.normal = turn * point.normal;
  }
  return points;
}

std::vector<double> exact_values(const std::filesystem::path& data,
                                 const std::vector<std::string>& keys) {
  const std::filesystem::path path = data / "cie171-exact.json";
  const io::Json json = io::parse_json(path);
  const io::Json* item = &json;
  for (const std::string& key : keys) {
    if (!item->contains(key)) {
      throw SceneError(fmt::format("{}: there is no \"{}\"", path.string(), key));
    }
    item = &item->at(key);
  }
  try {
    if (item->is_number()) return {item->get<double>()};
    return item->get<std::vector<double>>();
  } catch (const io::Json::exception& error) {
    throw SceneError(fmt::format("{}: {}", path.string(), error.what()));
  }
}

void add_exact(CaseResult& result, Table& table, const std::string& name,
               const std::vector<double>& computed, const std::vector<double>& exact, int digits,
               const std::string& unit) {
  const double half_a_unit = 0.5 * std::pow(10, -digits);
  double worst = computed.size() == exact.size() ? 0 : NAN;
  for (std::size_t k = 0; k < std::min(computed.size(), exact.size()); ++k) {
    worst = std::max(worst, std::abs(computed[k] - exact[k]));
  }
  // The values end in decimal fractions, so that a half is one only up to rounding.
  result.checks.push_back({name + ": most that a point is off", worst, half_a_unit * (1 + 1e-6),
                           "Half a unit of the last digit of our own exact values; points are "
                           "computed without sampling, to 1e-6 and better.",
                           unit});
  table.rows.push_back({name, listed(computed, digits), listed(exact, digits)});
}

}  // namespace apps::validation
