#include "io/base/json_item.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <set>
#include <utility>
#include <vector>

#include "io/base/line_reader.h"
#include "io/base/printable.h"
#include "radiosity/base/error.h"

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

/// What comes out of a parser may be copied and printed by functions that recurse.
constexpr int kDeepest = 500;
/// Keys of an object are looked for one after the other.
constexpr std::size_t kMostKeys = 10'000;

/// Notices keys that stand twice in one object, of which the parser would keep the last; refuses
/// what is nested too deep or has too many keys. A pass of its own, for the parser's callbacks look
/// at all elements of a list after each object in it.
class JsonCheck : public Json::json_sax_t {
 public:
  explicit JsonCheck(const std::filesystem::path& path) : path_(path) {}

  [[nodiscard]] const std::string& first() const { return first_; }

  bool start_object(std::size_t /*size*/) override {
    keys_.emplace_back();
    return enter();
  }
  bool key(std::string& key) override {
    if (!keys_.back().insert(key).second && first_.empty()) first_ = key;
    if (keys_.back().size() > kMostKeys) {
      fail(path_, fmt::format("has an object of more than {} keys", kMostKeys));
    }
    return true;
  }
  bool end_object() override {
    keys_.pop_back();
    return leave();
  }
  bool start_array(std::size_t /*size*/) override { return enter(); }
  bool end_array() override { return leave(); }
  bool null() override { return true; }
  bool boolean(bool /*value*/) override { return true; }
  bool number_integer(std::int64_t /*value*/) override { return true; }
  bool number_unsigned(std::uint64_t /*value*/) override { return true; }
  bool number_float(double /*value*/, const std::string& /*text*/) override { return true; }
  bool string(std::string& /*value*/) override { return true; }
  bool binary(Json::binary_t& /*value*/) override { return true; }
  /// The parser itself says what is wrong.
  bool parse_error(std::size_t /*position*/, const std::string& /*token*/,
                   const Json::exception& /*error*/) override {
    return false;
  }

 private:
  bool enter() {
    if (++depth_ > kDeepest) {
      fail(path_, fmt::format("has more than {} lists and objects inside each other", kDeepest));
    }
    return true;
  }
  bool leave() {
    --depth_;
    return true;
  }

  std::filesystem::path path_;
  std::vector<std::set<std::string>> keys_;  // of the objects that are open
  std::string first_;
  int depth_ = 0;
};

/// "room.json:12: ..." from the parser's "[json...] parse error at line 12, column 3: ...".
[[noreturn]] void fail_at_line(const std::filesystem::path& path, std::string_view message) {
  message = message.substr(std::min(message.find("] ") + 2, message.size()));
  constexpr std::string_view kStart = "parse error at line ";
  if (!message.starts_with(kStart)) fail(path, std::string(message));
  message.remove_prefix(kStart.size());
  const auto line = message.substr(0, message.find(','));
  const auto text = message.substr(std::min(message.find(": ") + 2, message.size()));
  throw radiosity::SceneError(printable(fmt::format("{}:{}: {}", path.string(), line, text)));
}

/// Whether it can be an object, behind a byte order mark, perhaps. What the parser's message has
/// read last is, in another kind of file, not ours to tell.
bool begins_object(std::string_view text) {
  const auto first = std::find_if(text.begin(), text.end(),
                                  [](unsigned char c) { return c < 0x80 && std::isspace(c) == 0; });
  return first != text.end() && *first == '{';
}

Json parse_checked(const std::filesystem::path& path, std::string_view text, JsonCheck& check) {
  (void)Json::sax_parse(text, &check);
  try {
    return Json::parse(text);
  } catch (const Json::exception& error) {
    if (!begins_object(text)) fail(path, "is no JSON object: it does not begin with {");
    fail_at_line(path, error.what());
  }
}

}  // namespace

Json parse_json(const std::filesystem::path& path) {
  input_size(path);
  std::ifstream file(path, std::ios::binary);
  const std::string text(std::istreambuf_iterator<char>(file), {});
  JsonCheck check(path);
  Json json = parse_checked(path, text, check);
  if (!check.first().empty()) {
    fail(path, fmt::format("key {} stands twice in one object", in_quotes(check.first())));
  }
  if (json.is_string()) fail(path, "is no scene in JSON: it holds a text only");
  return json;
}

Json parse_json_text(const std::filesystem::path& path, std::string_view text) {
  JsonCheck check(path);
  return parse_checked(path, text, check);
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
      printable(fmt::format("{}: {}{}{}", file_, place_, place_.empty() ? "" : ": ", message)));
}

void JsonItem::check_keys(std::span<const std::string_view> known) const {
  if (!value_->is_object()) fail("expected an object, found " + description(*value_));
  for (const auto& item : value_->items()) {
    const std::string& key = item.key();
    if (std::find(known.begin(), known.end(), key) != known.end()) continue;
    const auto nearest = std::min_element(known.begin(), known.end(), [&](auto a, auto b) {
      return edit_distance(key, a) < edit_distance(key, b);
    });
    // Further than half its letters, a word is no misspelling of the other.
    if (2 * edit_distance(key, *nearest) <= std::max(key.size(), nearest->size())) {
      fail(fmt::format("unknown key {}, did you mean \"{}\"?", in_quotes(key), *nearest));
    }
    fail(fmt::format("unknown key {}, nearest is \"{}\"; known are {}", in_quotes(key), *nearest,
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

std::optional<JsonItem> find_inside(const JsonItem& item,
                                    std::initializer_list<std::string_view> keys) {
  std::optional<JsonItem> found = item;
  for (const std::string_view key : keys) {
    if (!found->value().is_object()) return std::nullopt;
    std::optional<JsonItem> next = found->find(key);
    if (!next) return std::nullopt;
    found.emplace(*next);
  }
  return found;
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
