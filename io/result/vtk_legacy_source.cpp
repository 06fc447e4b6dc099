#include "io/result/vtk_legacy_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <charconv>
#include <fstream>
#include <limits>
#include <utility>

#include "io/base/line_reader.h"
#include "io/base/printable.h"
#include "io/result/vtp_values.h"

namespace io {
namespace {

constexpr std::string_view kLegacyBlanks = " \t\r\n";
constexpr std::string_view kLegacyHead = "# vtk DataFile Version ";

/// Types of legacy files as VTK XML calls them; vtkIdType is 32 bits wide wherever it is binary.
constexpr std::array<std::pair<std::string_view, std::string_view>, 15> kLegacyTypes = {
    {{"char", "Int8"},
     {"signed_char", "Int8"},
     {"unsigned_char", "UInt8"},
     {"short", "Int16"},
     {"unsigned_short", "UInt16"},
     {"int", "Int32"},
     {"vtkidtype", "Int32"},
     {"unsigned_int", "UInt32"},
     {"long", "Int64"},
     {"vtktypeint64", "Int64"},
     {"unsigned_long", "UInt64"},
     {"vtktypeuint64", "UInt64"},
     {"float", "Float32"},
     {"double", "Float64"},
     {"string", "String"}}};

std::string decoded(std::string_view text) {
  std::string result;
  for (std::size_t k = 0; k < text.size(); ++k) {
    unsigned code = 0;
    const char* const digits = text.data() + k + 1;
    if (text[k] == '%' && k + 2 < text.size() &&
        std::from_chars(digits, digits + 2, code, 16).ptr == digits + 2) {
      result += static_cast<char>(code);
      k += 2;
    } else {
      result += text[k];
    }
  }
  return result;
}

}  // namespace

VtkLegacySource::VtkLegacySource(const std::filesystem::path& path)
    : path_(path), content_(kLegacyHead.size(), '\0') {
  const std::uint64_t size = input_size(path);
  std::ifstream stream(path, std::ios::binary);
  // A file that is something else need not be read on.
  stream.read(content_.data(), static_cast<std::streamsize>(content_.size()));
  if (!stream || content_ != kLegacyHead) io::fail(path, "is no legacy VTK file (# vtk DataFile)");
  content_.resize(size);
  stream.read(content_.data() + kLegacyHead.size(),
              static_cast<std::streamsize>(size - kLegacyHead.size()));
  if (!stream) io::fail(path, "cannot be read to its end");
  place_ = kLegacyHead.size();
  const auto version = parse_number<double>(trimmed(line()));
  if (!version || !(*version >= 1 && *version < 6)) fail("has an unknown version");
  version_ = *version;
  line();  // a title
  const std::string kind = keyword("ASCII or BINARY");
  if (kind != "ascii" && kind != "binary") {
    fail(fmt::format("expected ASCII or BINARY, found {}", in_quotes(kind)));
  }
  is_binary_ = kind == "binary";
}

void VtkLegacySource::fail(const std::string& message) const {
  if (is_binary_) io::fail(path_, fmt::format("byte {}: {}", place_, message));
  const auto end = content_.begin() + static_cast<std::ptrdiff_t>(place_);
  io::fail(fmt::format("{}:{}", path_.string(), 1 + std::count(content_.begin(), end, '\n')),
           message);
}

std::size_t VtkLegacySource::next_word() const {
  return std::min(content_.find_first_not_of(kLegacyBlanks, place_), content_.size());
}

bool VtkLegacySource::is_at_end() const { return next_word() == content_.size(); }

std::string_view VtkLegacySource::word(std::string_view what) {
  place_ = next_word();
  if (place_ == content_.size()) fail(fmt::format("file ends where {} should stand", what));
  const std::size_t end = std::min(content_.find_first_of(kLegacyBlanks, place_), content_.size());
  const std::string_view result = std::string_view(content_).substr(place_, end - place_);
  place_ = end;
  return result;
}

std::string VtkLegacySource::keyword(std::string_view what) {
  std::string result(word(what));
  for (char& letter : result) letter = static_cast<char>(std::tolower(std::uint8_t(letter)));
  return result;
}

std::string VtkLegacySource::name(std::string_view what) { return decoded(word(what)); }

std::uint64_t VtkLegacySource::count(std::string_view what) {
  const std::string_view found = word(what);
  const auto number = parse_number<std::uint64_t>(found);
  constexpr std::uint64_t kMost = std::numeric_limits<std::int32_t>::max();
  if (!number || *number > kMost) {
    fail(fmt::format("expected {}, found {}", what, in_quotes(found)));
  }
  return *number;
}

std::string_view VtkLegacySource::rest_of_line() const {
  const std::size_t end = std::min(content_.find('\n', place_), content_.size());
  return std::string_view(content_).substr(place_, end - place_);
}

std::string_view VtkLegacySource::line() {
  const std::string_view result = rest_of_line();
  place_ = std::min(place_ + result.size() + 1, content_.size());
  return result;
}

std::string_view VtkLegacySource::take(std::uint64_t n, std::string_view what) {
  if (n > content_.size() - place_) {
    fail(fmt::format("file ends in {}: {} bytes are left, expected {}", what,
                     content_.size() - place_, n));
  }
  const std::string_view bytes = std::string_view(content_).substr(place_, n);
  place_ += n;
  return bytes;
}

std::string VtkLegacySource::values(const std::string& type, std::uint64_t n,
                                    std::string_view what) {
  if (is_binary_) line();  // the rest of the line that tells what comes
  const std::string xml_type = vtk_type_of_legacy(type);
  if (type == "bit" && is_binary_) {
    take((n + 7) / 8, what);
    return {};
  }
  if (xml_type == "String") return texts(n, what);
  if (xml_type.empty() && type != "bit") {
    fail(fmt::format("the type {} of {} is not known", in_quotes(type), what));
  }
  std::string bytes;
  if (is_binary_) {
    const std::size_t size = vtp_type_size(xml_type);
    bytes = take(n * size, what);
    if (std::endian::native == std::endian::little) reverse_bytes(bytes, size);
    return bytes;
  }
  for (std::uint64_t k = 0; k < n; ++k) {
    const std::string_view found = word(what);
    if (type != "bit" && !append_value(found, xml_type, bytes)) {
      fail(fmt::format("expected a {} in {}, found {}", type, what, in_quotes(found)));
    }
  }
  return bytes;
}

/// As text a line each; else each behind its length, whose bytes the two highest bits tell.
std::string VtkLegacySource::texts(std::uint64_t n, std::string_view what) {
  std::string result;
  if (!is_binary_ && n > 0) line();
  for (std::uint64_t k = 0; k < n; ++k) {
    if (place_ == content_.size()) fail(fmt::format("file ends in {}", what));
    if (!is_binary_) {
      result += decoded(trimmed(line()));
    } else {
      const unsigned first = std::uint8_t(content_[place_]);
      std::uint64_t length = 0;
      for (const char byte : take(8U >> (first >> 6), what))
        length = length << 8 | std::uint8_t(byte);
      const std::uint64_t mask = ~std::uint64_t{0} >> (64 - 8 * (8U >> (first >> 6)) + 2);
      result += take(length & mask, what);
    }
    result += '\0';
  }
  return result;
}

std::string vtk_type_of_legacy(const std::string& type) {
  const auto* const entry = std::find_if(kLegacyTypes.begin(), kLegacyTypes.end(),
                                         [&](const auto& known) { return known.first == type; });
  return entry == kLegacyTypes.end() ? "" : std::string(entry->second);
}

}  // namespace io
