#include "apps/summary/text_table.h"

#include <fmt/format.h>

#include <algorithm>

namespace apps {
namespace {

/// Number of characters that a UTF-8 text shows as (fmt counts the same way when it pads).
std::size_t width(const std::string& text) {
  return std::count_if(text.begin(), text.end(),
                       [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; });
}

}  // namespace

std::string line(std::string_view label, std::string_view value) {
  return fmt::format("{:<16}{}\n", label, value);
}

std::string table(const std::vector<Row>& rows) {
  std::vector<std::size_t> widths(rows.front().size());
  for (const Row& row : rows) {
    for (std::size_t c = 0; c < row.size(); ++c) widths[c] = std::max(widths[c], width(row[c]));
  }
  std::string text;
  for (const Row& row : rows) {
    text += fmt::format("  {:<{}}", row[0], widths[0]);
    for (std::size_t c = 1; c < row.size(); ++c) text += fmt::format("  {:>{}}", row[c], widths[c]);
    text += "\n";
  }
  return text;
}

std::string numbers(const Eigen::VectorXd& values) {
  if (values.size() > 4) {
    return fmt::format("{:.4g} .. {:.4g}", values.minCoeff(), values.maxCoeff());
  }
  std::string text;
  for (const double value : values) {
    text += fmt::format("{}{:.4g}", text.empty() ? "" : " ", value);
  }
  return text;
}

}  // namespace apps
