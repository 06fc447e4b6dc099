#include "viewer/script/script_arguments.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace viewer {

using nlohmann::json;

namespace {

[[noreturn]] void refuse(const std::string& key, const json& found, const char* expected) {
  throw std::invalid_argument(fmt::format("'{}' is {}, expected {}", key, found.dump(), expected));
}

}  // namespace

bool ScriptArguments::has(const std::string& key) {
  known_.insert(key);
  return values_.contains(key);
}

const json& ScriptArguments::value(const std::string& key) {
  if (!has(key)) throw std::invalid_argument(fmt::format("needs '{}'", key));
  return values_[key];
}

std::string ScriptArguments::text(const std::string& key) {
  const json& found = value(key);
  if (!found.is_string()) refuse(key, found, "a text");
  return found.get<std::string>();
}

std::string ScriptArguments::name(const std::string& key) {
  const json& found = value(key);
  if (found.is_number_integer()) return std::to_string(found.get<long>());
  return text(key);
}

double ScriptArguments::number(const std::string& key) {
  const json& found = value(key);
  if (!found.is_number()) refuse(key, found, "a number");
  return found.get<double>();
}

double ScriptArguments::number_or(const std::string& key, double otherwise) {
  return has(key) ? number(key) : otherwise;
}

long ScriptArguments::integer(const std::string& key) {
  const json& found = value(key);
  if (!found.is_number_integer()) refuse(key, found, "a whole number");
  return found.get<long>();
}

bool ScriptArguments::flag_or(const std::string& key, bool otherwise) {
  if (!has(key)) return otherwise;
  const json& found = value(key);
  if (!found.is_boolean()) refuse(key, found, "true or false");
  return found.get<bool>();
}

Eigen::VectorXd ScriptArguments::numbers(const std::string& key) {
  const json& found = value(key);
  if (!found.is_array()) refuse(key, found, "a list of numbers");
  Eigen::VectorXd result(static_cast<radiosity::Index>(found.size()));
  for (std::size_t k = 0; k < found.size(); ++k) {
    if (!found[k].is_number()) refuse(key, found, "a list of numbers");
    result[static_cast<radiosity::Index>(k)] = found[k].get<double>();
  }
  return result;
}

radiosity::Vec3 ScriptArguments::vector(const std::string& key) {
  const Eigen::VectorXd found = numbers(key);
  if (found.size() != 3 || !found.allFinite()) refuse(key, value(key), "three numbers");
  return found;
}

void ScriptArguments::check_all_used() const {
  for (const auto& [key, value] : values_.items()) {
    if (!known_.contains(key)) {
      throw std::invalid_argument(fmt::format("does not know '{}'", key));
    }
  }
}

}  // namespace viewer
