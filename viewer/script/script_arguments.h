#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>

#include "radiosity/base/geometry.h"

namespace viewer {

/// What an action of a script is given. Each getter throws std::invalid_argument, with what was
/// found and what was expected, and notes that the key is known.
class ScriptArguments {
 public:
  explicit ScriptArguments(nlohmann::json values) : values_(std::move(values)) {}

  [[nodiscard]] bool has(const std::string& key);
  std::string text(const std::string& key);
  /// A string, or a number as text.
  std::string name(const std::string& key);
  double number(const std::string& key);
  double number_or(const std::string& key, double otherwise);
  long integer(const std::string& key);
  bool flag_or(const std::string& key, bool otherwise);
  Eigen::VectorXd numbers(const std::string& key);
  radiosity::Vec3 vector(const std::string& key);
  /// The value as it is.
  const nlohmann::json& value(const std::string& key);
  /// Throws if a key was given that nobody has asked for.
  void check_all_used() const;

 private:
  nlohmann::json values_;
  std::set<std::string> known_ = {"action"};
};

}  // namespace viewer
