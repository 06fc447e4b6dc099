#include "io/result/node_numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <string_view>

#include "io/base/csv_field.h"
#include "io/base/line_reader.h"
#include "io/base/printable.h"
#include "radiosity/base/error.h"

namespace io {
namespace {

/// What a field of RFC 4180 holds.
std::string unquoted(std::string_view field) {
  if (field.size() < 2 || field.front() != '"' || field.back() != '"') return std::string(field);
  std::string text;
  for (std::size_t k = 1; k + 1 < field.size(); ++k) {
    text += field[k];
    if (field[k] == '"' && field[k + 1] == '"') ++k;
  }
  return text;
}

std::int64_t node_number(const LineReader& reader, std::string_view word) {
  std::int64_t number = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (error != std::errc() || end != word.data() + word.size() || number <= 0) {
    reader.fail("found " + reader.shown(word) + ", expected a node number above 0");
  }
  return number;
}

}  // namespace

std::vector<std::int64_t> read_node_numbers(const std::filesystem::path& path,
                                            const std::vector<std::string>& surfaces,
                                            const radiosity::Progress& progress) {
  LineReader reader(path, progress);
  std::vector<std::int64_t> numbers(surfaces.size(), 0);
  for (bool is_first = true; reader.next_line(); is_first = false) {
    const std::string_view line = trimmed(reader.line());
    if (line.empty() || (is_first && line == "surface,node")) {
      reader.recognise();
      continue;
    }
    const std::size_t comma = line.rfind(',');
    if (comma == std::string_view::npos)
      reader.fail("expected a surface, a comma and a node number");
    const std::string name = csv_text(unquoted(trimmed(line.substr(0, comma))));
    const auto found = std::find(surfaces.begin(), surfaces.end(), name);
    if (found == surfaces.end()) {
      reader.fail("the scene has no surface " + reader.shown(name));
    }
    reader.recognise();
    const std::int64_t number = node_number(reader, trimmed(line.substr(comma + 1)));
    std::int64_t& its = numbers[static_cast<std::size_t>(found - surfaces.begin())];
    if (its != 0) reader.fail("surface " + reader.shown(name) + " has a number already");
    if (std::find(numbers.begin(), numbers.end(), number) != numbers.end()) {
      reader.fail(fmt::format("node {} is there twice", number));
    }
    its = number;
  }
  const auto missing = std::find(numbers.begin(), numbers.end(), 0);
  if (missing != numbers.end()) {
    throw radiosity::SceneError(
        fmt::format("{}: has no node for surface '{}'", path.string(),
                    printable(surfaces[static_cast<std::size_t>(missing - numbers.begin())])));
  }
  return numbers;
}

}  // namespace io
