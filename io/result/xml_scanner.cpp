#include "io/result/xml_scanner.h"

#include <algorithm>
#include <array>
#include <utility>

namespace io {
namespace {

constexpr std::string_view kBlanks = " \t\r\n";
constexpr std::size_t kDeepest = 32;  // VTK nests six elements

/// The value with its entities replaced; others stay as they are.
std::string unescaped(std::string_view value) {
  constexpr std::array<std::pair<std::string_view, char>, 5> kEntities = {
      {{"&lt;", '<'}, {"&gt;", '>'}, {"&amp;", '&'}, {"&quot;", '"'}, {"&apos;", '\''}}};
  std::string result;
  while (!value.empty()) {
    const auto* const entity =
        std::find_if(kEntities.begin(), kEntities.end(),
                     [&](const auto& known) { return value.starts_with(known.first); });
    result += entity == kEntities.end() ? value.front() : entity->second;
    value.remove_prefix(entity == kEntities.end() ? 1 : entity->first.size());
  }
  return result;
}

}  // namespace

std::string XmlScanner::attribute(const std::string& key) const {
  const auto entry = attributes_.find(key);
  return entry == attributes_.end() ? "" : entry->second;
}

bool XmlScanner::next() {
  if (is_damaged_) return false;
  if (std::exchange(is_entering_, false)) open_.push_back(name_);
  for (;;) {
    const std::size_t start = text_.find('<');
    before_ = text_.substr(0, start);
    if (start == std::string_view::npos) {
      is_damaged_ = !open_.empty();
      return false;
    }
    text_.remove_prefix(start);
    if (text_.starts_with("<!--")) {
      if (!skip("-->")) return false;
    } else if (text_.starts_with("<?")) {
      if (!skip("?>")) return false;
    } else {
      is_damaged_ = !scan_tag();
      return !is_damaged_;
    }
  }
}

bool XmlScanner::scan_tag() {
  text_.remove_prefix(1);
  const bool is_end = text_.starts_with('/');
  if (is_end) text_.remove_prefix(1);
  name_ = scan_name();
  if (name_.empty() || !scan_attributes()) return false;
  const bool is_empty = text_.starts_with('/');
  if (is_empty) text_.remove_prefix(1);
  if (!text_.starts_with('>') || (is_empty && is_end)) return false;
  text_.remove_prefix(1);
  kind_ = is_end ? Kind::end : is_empty ? Kind::empty : Kind::start;
  is_entering_ = kind_ == Kind::start;
  if (is_entering_) return open_.size() < kDeepest;
  if (!is_end) return true;
  if (open_.empty() || open_.back() != name_) return false;
  open_.pop_back();
  return true;
}

bool XmlScanner::scan_attributes() {
  attributes_.clear();
  for (skip_blanks(); !text_.empty() && text_[0] != '/' && text_[0] != '>'; skip_blanks()) {
    const std::string key = scan_name();
    skip_blanks();
    if (key.empty() || !text_.starts_with('=')) return false;
    text_.remove_prefix(1);
    skip_blanks();
    if (text_.empty() || (text_[0] != '"' && text_[0] != '\'')) return false;
    const std::size_t end = text_.find(text_[0], 1);
    if (end == std::string_view::npos) return false;
    if (!attributes_.try_emplace(key, unescaped(text_.substr(1, end - 1))).second) return false;
    text_.remove_prefix(end + 1);
  }
  return true;
}

bool XmlScanner::skip(std::string_view end) {
  const std::size_t place = text_.find(end);
  is_damaged_ = place == std::string_view::npos;
  if (!is_damaged_) text_.remove_prefix(place + end.size());
  return !is_damaged_;
}

void XmlScanner::skip_blanks() {
  text_.remove_prefix(std::min(text_.find_first_not_of(kBlanks), text_.size()));
}

std::string XmlScanner::scan_name() {
  const std::size_t end = std::min(text_.find_first_of(" \t\r\n=/><\"'"), text_.size());
  std::string name(text_.substr(0, end));
  text_.remove_prefix(end);
  return name;
}

}  // namespace io
