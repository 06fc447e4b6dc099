#include "io/scene/scenario_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

#include "io/base/json_item.h"
#include "io/scene/light_factor.h"

namespace io {
namespace {

using radiosity::Scenario;

constexpr auto kFileKeys = std::to_array<std::string_view>({"description", "scenarios"});
constexpr auto kScenarioKeys =
    std::to_array<std::string_view>({"name", "description", "lights", "reflectances"});

/// Names stand in file names.
std::string read_name(const JsonItem& item) {
  const std::string name = item.text();
  const bool is_plain = std::all_of(name.begin(), name.end(), [](char c) {
    return c != '/' && static_cast<unsigned char>(c) >= 32 && c != 127;
  });
  if (!is_plain) item.fail("found a '/' or a control character, which file names may not have");
  return name;
}

double read_share(const JsonItem& item) {
  const double share = item.number();
  if (!(share >= 0 && share <= 1)) {
    item.fail(fmt::format("found {}, expected a reflectance from 0 to 1", share));
  }
  return share;
}

Eigen::VectorXd read_shares(const JsonItem& item) {
  if (!item.value().is_array()) return Eigen::VectorXd::Constant(1, read_share(item));
  if (item.size() == 0) item.fail("found no value, expected one or one for each band");
  Eigen::VectorXd values(static_cast<Eigen::Index>(item.size()));
  for (std::size_t k = 0; k < item.size(); ++k) {
    values[static_cast<Eigen::Index>(k)] = read_share(item[k]);
  }
  return values;
}

void require_object(const JsonItem& item) {
  if (!item.value().is_object()) item.fail("expected an object of names and values");
}

Scenario read_scenario(const JsonItem& item) {
  item.check_keys(kScenarioKeys);
  Scenario scenario{.name = read_name(item.at("name"))};
  if (const auto lights = item.find("lights")) {
    require_object(*lights);
    for (const auto& [pattern, value] : lights->value().items()) {
      scenario.lights.push_back({pattern, read_light_factor(lights->at(pattern))});
    }
  }
  if (const auto paints = item.find("reflectances")) {
    require_object(*paints);
    for (const auto& [pattern, value] : paints->value().items()) {
      scenario.paints.push_back({pattern, read_shares(paints->at(pattern))});
    }
  }
  return scenario;
}

}  // namespace

std::vector<Scenario> read_scenarios(const std::filesystem::path& path) {
  const Json json = parse_json(path);
  const JsonItem file(json, path);
  file.check_keys(kFileKeys);
  const JsonItem list = file.at("scenarios");
  std::vector<Scenario> scenarios;
  for (std::size_t k = 0; k < list.size(); ++k) {
    scenarios.push_back(read_scenario(list[k]));
    const bool is_new =
        std::none_of(scenarios.begin(), scenarios.end() - 1,
                     [&](const Scenario& other) { return other.name == scenarios.back().name; });
    if (!is_new) list[k].at("name").fail("is the name of another scenario, too");
  }
  if (scenarios.empty()) list.fail("found no scenario");
  return scenarios;
}

}  // namespace io
