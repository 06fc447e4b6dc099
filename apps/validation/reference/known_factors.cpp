#include "apps/validation/reference/known_factors.h"

#include <fmt/format.h>

#include <cstdlib>
#include <optional>

#include "io/base/json_item.h"
#include "radiosity/base/error.h"

namespace apps::validation {
namespace {

using io::Json;
using radiosity::SceneError;

/// The number that a JSON number or a string of digits stands for; none if it is in words.
std::optional<double> number(const Json& item) {
  if (item.is_number()) return item.get<double>();
  if (!item.is_string()) return std::nullopt;
  const auto& text = item.get_ref<const std::string&>();
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  return !text.empty() && *end == '\0' ? std::optional(value) : std::nullopt;
}

std::vector<double> numbers(const Json& item) {
  std::vector<double> list;
  if (const auto single = number(item)) return {*single};
  if (!item.is_array()) return list;
  for (const Json& part : item) {
    if (const auto value = number(part)) list.push_back(*value);
  }
  return list;
}

std::vector<radiosity::Vec3> polygon(const Json& entry, const char* key) {
  std::vector<radiosity::Vec3> corners;
  if (!entry.contains(key)) return corners;
  for (const Json& point : entry.at(key)) {
    const std::vector<double> x = numbers(point);
    if (x.size() != 3) throw SceneError(fmt::format("a corner of {} is not three numbers", key));
    corners.emplace_back(x[0], x[1], x[2]);
  }
  return corners;
}

KnownFactor read_entry(const Json& entry) {
  KnownFactor known{.name = entry.at("name").get<std::string>(),
                    .kind = entry.at("kind").get<std::string>(),
                    .polygon1 = polygon(entry, "polygon1"),
                    .polygon2 = polygon(entry, "polygon2")};
  if (entry.contains("A1F12")) known.exchange_area = number(entry.at("A1F12")).value_or(0);
  if (entry.contains("F12")) known.values["F12"] = numbers(entry.at("F12"));
  const Json params = entry.value("params", Json::object());
  for (const auto& [key, item] : params.items()) {
    if (const auto value = number(item)) known.params[key] = *value;
  }
  const Json values = entry.value("values", Json::object());
  for (const auto& [key, item] : values.items()) {
    known.values[key] = numbers(item);
  }
  return known;
}

}  // namespace

double KnownFactor::value(const std::string& key) const {
  const auto found = values.find(key);
  if (found == values.end() || found->second.size() != 1) {
    throw SceneError(fmt::format("form-factors.json: '{}' has no number '{}'", name, key));
  }
  return found->second.front();
}

std::vector<KnownFactor> read_known_factors(const std::filesystem::path& data) {
  const std::filesystem::path path = data / "form-factors.json";
  const Json known = io::parse_json(path);
  try {
    std::vector<KnownFactor> list;
    for (const Json& entry : known.at("cases")) list.push_back(read_entry(entry));
    return list;
  } catch (const Json::exception& error) {
    throw SceneError(fmt::format("{}: {}", path.string(), error.what()));
  } catch (const SceneError& error) {
    throw SceneError(fmt::format("{}: {}", path.string(), error.what()));
  }
}

const KnownFactor& known_factor(const std::vector<KnownFactor>& list, std::string_view part) {
  for (const KnownFactor& known : list) {
    if (known.name.find(part) != std::string::npos) return known;
  }
  throw SceneError(fmt::format("form-factors.json: there is no case '{}'", part));
}

}  // namespace apps::validation
