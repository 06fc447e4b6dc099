#include "io/scene/epw_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "io/base/line_reader.h"

namespace io {
namespace {

/// Fields of a line of data, from 0 (EnergyPlus, Auxiliary Programs: EPW data dictionary).
constexpr std::size_t kDirectNormal = 14;
constexpr std::size_t kDiffuseHorizontal = 15;
constexpr std::size_t kDirectIlluminance = 17;
constexpr std::size_t kDiffuseIlluminance = 18;
constexpr std::size_t kLeastFields = 19;
/// From here on values stand for "missing".
constexpr double kNoRadiation = 9999;
constexpr double kNoIlluminance = 999900;
constexpr std::size_t kHoursOfYear = 8760;
constexpr std::size_t kHoursOfLeapYear = 8784;

std::vector<std::string_view> fields_of(std::string_view line) {
  std::vector<std::string_view> fields;
  while (true) {
    const std::size_t comma = line.find(',');
    fields.push_back(trimmed(line.substr(0, comma)));
    if (comma == std::string_view::npos) return fields;
    line.remove_prefix(comma + 1);
  }
}

double number_of(const LineReader& reader, const std::vector<std::string_view>& fields,
                 std::size_t k, const char* name) {
  if (k >= fields.size()) {
    reader.fail(fmt::format("has {} fields, and {} is field {}", fields.size(), name, k + 1));
  }
  const auto value = parse_number<double>(fields[k]);
  if (!value || !std::isfinite(*value)) {
    reader.fail(fmt::format("{} is \"{}\", expected a number", name, fields[k]));
  }
  return *value;
}

std::optional<double> measured(const LineReader& reader,
                               const std::vector<std::string_view>& fields, std::size_t k,
                               const char* name, double missing) {
  const double value = number_of(reader, fields, k, name);
  if (value >= missing) return std::nullopt;
  if (value < 0) reader.fail(fmt::format("{} is {}, expected no negative number", name, value));
  return value;
}

void read_location(const LineReader& reader, WeatherYear& year) {
  const auto fields = fields_of(reader.line());
  if (fields[0] != "LOCATION") reader.fail("expected LOCATION: this is no EnergyPlus weather file");
  year.latitude = number_of(reader, fields, 6, "the latitude");
  year.longitude = number_of(reader, fields, 7, "the longitude");
  year.time_zone = number_of(reader, fields, 8, "the time zone");
  if (std::abs(year.latitude) > 90 || std::abs(year.longitude) > 180) {
    reader.fail("latitude or longitude is outside [-90, 90] or [-180, 180]");
  }
}

WeatherHour read_hour(const LineReader& reader) {
  const auto fields = fields_of(reader.line());
  if (fields.size() < kLeastFields) {
    reader.fail(fmt::format("has {} fields, expected {} at least", fields.size(), kLeastFields));
  }
  WeatherHour hour;
  hour.month = static_cast<int>(number_of(reader, fields, 1, "the month"));
  hour.day = static_cast<int>(number_of(reader, fields, 2, "the day"));
  hour.hour = static_cast<int>(number_of(reader, fields, 3, "the hour"));
  if (hour.month < 1 || hour.month > 12 || hour.day < 1 || hour.day > 31 || hour.hour < 1 ||
      hour.hour > 24) {
    reader.fail("month, day or hour is out of range, expected 1 to 12, 1 to 31 and 1 to 24");
  }
  hour.direct_normal =
      measured(reader, fields, kDirectNormal, "direct normal radiation", kNoRadiation);
  hour.diffuse_horizontal =
      measured(reader, fields, kDiffuseHorizontal, "diffuse horizontal radiation", kNoRadiation);
  hour.direct_normal_illuminance =
      measured(reader, fields, kDirectIlluminance, "direct normal illuminance", kNoIlluminance);
  hour.diffuse_horizontal_illuminance = measured(reader, fields, kDiffuseIlluminance,
                                                 "diffuse horizontal illuminance", kNoIlluminance);
  return hour;
}

/// Hours since the year began, of months as long as they get.
int order_of(const WeatherHour& hour) { return (hour.month * 32 + hour.day) * 25 + hour.hour; }

void tell_gaps(const std::string& file, WeatherYear& year) {
  const auto& hours = year.hours;
  std::size_t n_unordered = 0;
  std::size_t n_without = 0;
  for (std::size_t k = 0; k < hours.size(); ++k) {
    n_unordered += k > 0 && order_of(hours[k]) <= order_of(hours[k - 1]) ? 1 : 0;
    n_without += hours[k].direct_normal && hours[k].diffuse_horizontal ? 0 : 1;
  }
  if (hours.size() != kHoursOfYear && hours.size() != kHoursOfLeapYear) {
    year.warnings.push_back(
        fmt::format("{}: has {} hours, a year has {}", file, hours.size(), kHoursOfYear));
  }
  if (n_unordered > 0) {
    year.warnings.push_back(
        fmt::format("{}: {} hours do not follow the one before", file, n_unordered));
  }
  if (n_without > 0) {
    year.warnings.push_back(
        fmt::format("{}: {} hours have no direct or no diffuse radiation", file, n_without));
  }
}

}  // namespace

const WeatherHour* WeatherYear::find(int month, int day, int hour) const {
  const auto found = std::find_if(hours.begin(), hours.end(), [&](const WeatherHour& h) {
    return h.month == month && h.day == day && h.hour == hour;
  });
  return found == hours.end() ? nullptr : &*found;
}

WeatherYear read_epw(const std::filesystem::path& path, const radiosity::Progress& progress) {
  LineReader reader(path, progress);
  WeatherYear year;
  if (!reader.next_line()) fail(path, "is empty");
  read_location(reader, year);
  bool has_data = false;
  while (reader.next_line()) {
    const std::string_view line = trimmed(reader.line());
    if (has_data && !line.empty()) year.hours.push_back(read_hour(reader));
    has_data = has_data || line.starts_with("DATA PERIODS");
  }
  if (year.hours.empty()) fail(path, "has no hours after DATA PERIODS");
  tell_gaps(path.string(), year);
  return year;
}

}  // namespace io
