#include "io/json_item.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <set>
#include <utility>
#include <vector>

#include "io/line_reader.h"
#include "io/printable.h"
#include "radiosity/error.h"

namespace io {
namespace {

using radiosity::Vec3;

/// "an object", "the string "abc"", "the number 3" for messages.
std::string description(const Json& value) {
  if (value.is_object()) return "an object";
  if (value.is_array()) return fmt::format("a list of {}", value.size());
  if (value.is_null()) return "null";
  if (value.is_string()) return in_quotes(value.get_ref<const std::string&>());
  return value.dump();
}

/// Notices keys that stand twice in one object, of which the parser would keep the last.
class DuplicateKeys {
 public:
  bool operator()(Json::parse_event_t event, const Json& parsed) {
    if (event == Json::parse_event_t::object_start) keys_.emplace_back();
    if (event == Json::parse_event_t::object_end) keys_.pop_back();
    if (event == Json::parse_event_t::key) {
      const auto& key = parsed.get_ref<const std::string&>();
      if (!keys_.back().insert(key).second && first_.empty()) first_ = key;
    }
    return true;
  }
  [[nodiscard]] const std::string& first() const { return first_; }

 private:
  std::vector<std::set<std::string>> keys_;  // of the objects that are open
  std::string first_;
};

/// "room.json:12: ..." from the parser's "[json...] parse error at line 12, column 3: ...".
[[noreturn]] void fail_at_line(const std::filesystem::path& path, std::string_view message) {
  message = message.substr(std::min(message.find("] ") + 2, message.size()));
  constexpr std::string_view kStart = "parse error at line ";
  if (!message.starts_with(kStart)) fail(path, std::string(message));
  message.remove_prefix(kStart.size());
  const auto line = message.substr(0, message.find(','));
  const auto text = message.substr(std::min(message.find(": ") + 2, message.size()));
  throw radiosity::SceneError(fmt::format("{}:{}: {}", path.string(), line, text));
}

bool begins_object(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  char first = '\0';
  for (file >> first; file && static_cast<unsigned char>(first) >= 0x80;) file >> first;
  return first == '{';
}

}  // namespace

Json parse_json(const std::filesystem::path& path) {
  input_size(path);
  std::ifstream file(path, std::ios::binary);
  DuplicateKeys duplicates;
  Json json;
  try {
    json = Json::parse(file, [&](int /*depth*/, Json::parse_event_t event, Json& parsed) {
      return duplicates(event, parsed);
    });
  } catch (const Json::exception& error) {
    // The parser's message has what it read last, which of another kind of file is not ours to
    // tell.
    if (!begins_object(path)) fail(path, "is no scene in JSON: it does not begin with {");
    fail_at_line(path, error.what());
  }
  if (!duplicates.first().empty()) {
    fail(path, fmt::format("key \"{}\" stands twice in one object", duplicates.first()));
  }
  if (json.is_string()) fail(path, "is no scene in JSON: it holds a text only");
  return json;
}

std::optional<Vec3> as_point(const Json& value) {
  if (!value.is_array() || value.size() != 3) return std::nullopt;
  Vec3 point;
  for (int k = 0; k < 3; ++k) {
    if (!value[k].is_number()) return std::nullopt;
    point[k] = value[k].get<double>();
  }
  return point;
}

void JsonItem::fail(const std::string& message) const {
  throw radiosity::SceneError(
      fmt::format("{}: {}{}{}", file_, place_, place_.empty() ? "" : ": ", message));
}

void JsonItem::check_keys(std::span<const std::string_view> known) const {
  if (!value_->is_object()) fail("expected an object, found " + description(*value_));
  for (const auto& [key, unused] : value_->items()) {
    if (std::find(known.begin(), known.end(), key) != known.end()) continue;
    const auto nearest = std::min_element(known.begin(), known.end(), [&](auto a, auto b) {
      return edit_distance(key, a) < edit_distance(key, b);
    });
    // Further than half its letters, a word is no misspelling of the other.
    if (2 * edit_distance(key, *nearest) <= std::max(key.size(), nearest->size())) {
      fail(fmt::format("unknown key \"{}\", did you mean \"{}\"?", key, *nearest));
    }
    fail(fmt::format("unknown key \"{}\", nearest is \"{}\"; known are {}", key, *nearest,
                     fmt::join(known, ", ")));
  }
}

JsonItem JsonItem::at(std::string_view key) const {
  if (!value_->is_object()) fail("expected an object, found " + description(*value_));
  const auto entry = value_->find(key);
  if (entry == value_->end()) fail(fmt::format("has no \"{}\"", key));
  return {*entry, file_, place_.empty() ? std::string(key) : fmt::format("{}.{}", place_, key)};
}

std::optional<JsonItem> JsonItem::find(std::string_view key) const {
  if (!has(key)) return std::nullopt;
  return at(key);
}

JsonItem JsonItem::operator[](std::size_t i) const {
  return {(*value_)[i], file_, fmt::format("{}[{}]", place_, i)};
}

std::size_t JsonItem::size() const {
  if (!value_->is_array()) fail("expected a list, found " + description(*value_));
  return value_->size();
}

double JsonItem::number() const {
  if (!value_->is_number()) fail("expected a number, found " + description(*value_));
  return value_->get<double>();
}

std::string JsonItem::text() const {
  if (!value_->is_string()) fail("expected a string, found " + description(*value_));
  auto text = value_->get<std::string>();
  if (text.empty()) fail("is an empty string");
  return text;
}

bool JsonItem::boolean() const {
  if (!value_->is_boolean()) fail("expected true or false, found " + description(*value_));
  return value_->get<bool>();
}

Vec3 JsonItem::point() const {
  const auto point = as_point(*value_);
  if (!point) fail("expected three numbers [x, y, z], found " + description(*value_));
  return *point;
}

Vec3 JsonItem::direction() const {
  const Vec3 direction = point();
  const double length = direction.stableNorm();
  if (!(length > 0)) fail("is [0, 0, 0], expected a direction");
  // One that has unit length to rounding is kept, so that what was written reads back the same.
  if (std::abs(length - 1) < 4 * std::numeric_limits<double>::epsilon()) return direction;
  return direction / length;
}

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);  // distances of a's beginning to all of b's
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i + 1);
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, diagonal + 1});
    }
  }
  return row[b.size()];
}

}  // namespace io
