#include "io/result/energyplus_factors.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <set>

#include "io/base/atomic_file.h"
#include "io/base/extension.h"
#include "io/base/json_item.h"
#include "io/base/line_reader.h"

namespace io {
namespace {

constexpr const char* kType = "ZoneProperty:UserViewFactors:BySurfaceName";

/// The indices of a zone's surfaces.
std::vector<Eigen::Index> members(const ZoneFactors& table, const std::string& zone) {
  std::vector<Eigen::Index> result;
  for (std::size_t s = 0; s < table.zones.size(); ++s) {
    if (table.zones[s] == zone) result.push_back(static_cast<Eigen::Index>(s));
  }
  return result;
}

std::vector<std::string> zones_in_order(const ZoneFactors& table) {
  std::vector<std::string> zones;
  std::set<std::string> known;
  for (const std::string& zone : table.zones) {
    if (known.insert(zone).second) zones.push_back(zone);
  }
  return zones;
}

std::string as_idf(const ZoneFactors& table) {
  std::string text = "! Form factors of each zone: from, to, F.\n";
  for (const std::string& zone : zones_in_order(table)) {
    text += fmt::format("\n{},\n  {}", kType, zone);
    const auto surfaces = members(table, zone);
    for (const Eigen::Index from : surfaces) {
      for (const Eigen::Index to : surfaces) {
        text += fmt::format(",\n  {},{},{:.9f}", table.surfaces[static_cast<std::size_t>(from)],
                            table.surfaces[static_cast<std::size_t>(to)], table.factors(from, to));
      }
    }
    text += ";\n";
  }
  return text;
}

std::string as_json(const ZoneFactors& table) {
  Json objects = Json::object();
  for (const std::string& zone : zones_in_order(table)) {
    Json list = Json::array();
    const auto surfaces = members(table, zone);
    for (const Eigen::Index from : surfaces) {
      for (const Eigen::Index to : surfaces) {
        list.push_back({{"from_surface", table.surfaces[static_cast<std::size_t>(from)]},
                        {"to_surface", table.surfaces[static_cast<std::size_t>(to)]},
                        {"view_factor", table.factors(from, to)}});
      }
    }
    objects[fmt::format("Form factors of {}", zone)] = {
        {"zone_or_zonelist_or_space_or_spacelist_name", zone}, {"view_factors", std::move(list)}};
  }
  Json document = Json::object();
  document[kType] = std::move(objects);
  return document.dump(1) + '\n';
}

/// Whether the name stands as it is between commas.
void check_name(const std::filesystem::path& path, const std::string& name) {
  if (name.find_first_of(",;!\n\r") == std::string::npos && trimmed(name) == name) return;
  fail(path, fmt::format("cannot hold the name \"{}\", which has a comma, a semicolon, an "
                         "exclamation mark or blanks around it; .epJSON can",
                         name));
}

}  // namespace

void check_energyplus_names(const std::filesystem::path& path, const ZoneFactors& table) {
  if (lower_case_extension(path) != ".idf") return;
  for (const std::string& name : table.surfaces) check_name(path, name);
  for (const std::string& name : table.zones) check_name(path, name);
}

void write_energyplus_factors(const std::filesystem::path& path, const ZoneFactors& table) {
  check_energyplus_names(path, table);
  const std::string text = lower_case_extension(path) == ".idf" ? as_idf(table) : as_json(table);
  write_stream_atomically(path, [&](std::ofstream& stream) { stream << text; });
}

}  // namespace io
