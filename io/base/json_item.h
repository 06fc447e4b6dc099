#pragma once

#include <filesystem>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "radiosity/base/geometry.h"

namespace io {

using Json = nlohmann::ordered_json;

/// Parses a JSON file. Throws SceneError with file and line for a syntax error, for a key that an
/// object has twice, and for lists and objects more than 500 inside each other or objects of more
/// than 10,000 keys.
Json parse_json(const std::filesystem::path& path);

/// The same of text that stands in the file `path`; of a key that stands twice the last counts.
Json parse_json_text(const std::filesystem::path& path, std::string_view text);

/// Three numbers; empty if `value` is anything else.
std::optional<radiosity::Vec3> as_point(const Json& value);

/// A value in a JSON file together with where it stands: "scene.json: surfaces[2].transform". All
/// functions throw SceneError starting with this place if the value is not what is asked for.
class JsonItem {
 public:
  /// The whole document of the file `path`. `value` must outlive the item and its parts.
  JsonItem(const Json& value, const std::filesystem::path& path)
      : value_(&value), file_(path.string()) {}

  [[noreturn]] void fail(const std::string& message) const;
  /// Must be an object without keys other than `known`; proposes the nearest one.
  void check_keys(std::span<const std::string_view> known) const;

  [[nodiscard]] bool has(std::string_view key) const { return value_->contains(key); }
  [[nodiscard]] JsonItem at(std::string_view key) const;                   ///< must be there
  [[nodiscard]] std::optional<JsonItem> find(std::string_view key) const;  ///< empty: not there
  [[nodiscard]] JsonItem operator[](std::size_t i) const;                  ///< i < size()
  [[nodiscard]] std::size_t size() const;                                  ///< must be an array

  [[nodiscard]] double number() const;
  [[nodiscard]] std::string text() const;  ///< must be a string, not an empty one
  [[nodiscard]] bool boolean() const;
  [[nodiscard]] radiosity::Vec3 point() const;      ///< [x, y, z]
  [[nodiscard]] radiosity::Vec3 direction() const;  ///< [x, y, z], not zero; returns unit length

  [[nodiscard]] const Json& value() const { return *value_; }

 private:
  JsonItem(const Json& value, std::string file, std::string place)
      : value_(&value), file_(std::move(file)), place_(std::move(place)) {}

  const Json* value_;
  std::string file_;
  std::string place_;  // "surfaces[2].transform"; empty for the document
};

/// The item at keys inside each other, if all are there.
std::optional<JsonItem> find_inside(const JsonItem& item,
                                    std::initializer_list<std::string_view> keys);

/// Number of letters to insert, delete or replace to turn one word into the other (Levenshtein).
std::size_t edit_distance(std::string_view a, std::string_view b);

}  // namespace io
