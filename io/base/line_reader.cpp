#include "io/base/line_reader.h"

#include <fmt/format.h>

#include <cmath>

#include "io/base/printable.h"
#include "radiosity/base/error.h"

namespace io {
namespace {

constexpr std::string_view kBlanks = " \t\r\v\f";
constexpr std::size_t kLineBufferSize = 1 << 16;
constexpr long kLinesBetweenChecks = 1 << 16;
constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";

/// Whether a # that starts a word is in the line: behind it all is comment.
bool has_comment(std::string_view line) {
  for (auto at = line.find('#'); at != std::string_view::npos; at = line.find('#', at + 1)) {
    if (at == 0 || kBlanks.find(line[at - 1]) != std::string_view::npos) return true;
  }
  return false;
}

}  // namespace

void fail(const std::filesystem::path& path, const std::string& message) {
  throw radiosity::SceneError(printable(fmt::format("{}: {}", path.string(), message)));
}

std::uint64_t input_size(const std::filesystem::path& path) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) fail(path, "no such file");
  if (std::filesystem::is_directory(status)) fail(path, "is a folder, expected a file");
  // Before anything opens it: a pipe that nobody writes to would make that wait for ever.
  if (!std::filesystem::is_regular_file(status)) {
    fail(path, "is a pipe, a device or a socket, expected a file");
  }
  const auto size = std::filesystem::file_size(path, error);
  if (error) fail(path, "cannot be read: " + error.message());
  if (!std::ifstream(path, std::ios::binary)) fail(path, "cannot be opened for reading");
  if (size == 0) fail(path, "is empty");
  return size;
}

std::string_view trimmed(std::string_view text) {
  const auto begin = text.find_first_not_of(kBlanks);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kBlanks) - begin + 1);
}

std::vector<std::string_view> comma_fields(std::string_view line) {
  std::vector<std::string_view> fields;
  while (true) {
    const std::size_t comma = line.find(',');
    fields.push_back(trimmed(line.substr(0, comma)));
    if (comma == std::string_view::npos) return fields;
    line.remove_prefix(comma + 1);
  }
}

std::string_view Words::next() {
  const auto begin = rest_.find_first_not_of(kBlanks);
  if (begin == std::string_view::npos) {
    rest_ = {};
    return {};
  }
  const auto end = std::min(rest_.find_first_of(kBlanks, begin), rest_.size());
  const auto word = rest_.substr(begin, end - begin);
  rest_.remove_prefix(end);
  return word;
}

LineReader::LineReader(const std::filesystem::path& path, const radiosity::Progress& progress,
                       Continuation continuation)
    : path_(path),
      progress_(progress),
      continuation_(continuation),
      size_(input_size(path)),
      buffer_(kLineBufferSize) {
  file_.rdbuf()->pubsetbuf(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
  file_.open(path, std::ios::binary);
}

bool LineReader::read_physical_line(std::string& line) {
  if (!std::getline(file_, line)) return false;
  offset_ += line.size() + (file_.eof() ? 0 : 1);
  if (!line.empty() && line.back() == '\r') line.pop_back();
  if (line_number_ == 0) {
    if (line.starts_with("\xff\xfe") || line.starts_with("\xfe\xff")) {
      io::fail(path_, "is text in UTF-16, expected UTF-8; save it as that");
    }
    if (line.starts_with(kByteOrderMark)) line.erase(0, kByteOrderMark.size());
  }
  if (++line_number_ % kLinesBetweenChecks == 0) {
    progress_.check();
    if (progress_.report) {
      progress_.report("reading", static_cast<double>(offset_), static_cast<double>(size_),
                       "bytes");
    }
  }
  return true;
}

bool LineReader::next_line() {
  if (!read_physical_line(line_)) return false;
  first_line_number_ = line_number_;
  if (continuation_ == Continuation::none) return true;
  while (!line_.empty() && line_.back() == '\\' && !has_comment(line_)) {
    line_.back() = ' ';
    if (!read_physical_line(joined_)) break;
    line_ += joined_;
  }
  return true;
}

bool LineReader::next_content() {
  while (next_line()) {
    line_.resize(std::min(line_.find('#'), line_.size()));
    if (line_.find_first_not_of(kBlanks) != std::string::npos) return true;
  }
  return false;
}

void LineReader::skip_to(std::uint64_t offset) {
  file_.clear();
  file_.seekg(static_cast<std::streamoff>(offset));
  offset_ = offset;
}

void LineReader::fail(const std::string& message) const {
  throw radiosity::SceneError(
      printable(fmt::format("{}:{}: {}", path_.string(), first_line_number_, message)));
}

std::string LineReader::shown(std::string_view word) const {
  return is_recognised_ ? in_quotes(word) : fmt::format("a word of {} bytes", word.size());
}

double LineReader::number(Words& words, std::string_view what) const {
  const std::string_view word = words.next();
  if (word.empty()) fail(fmt::format("line ends where {} is expected", what));
  const auto value = parse_number<double>(word);
  if (!value) fail(fmt::format("expected a number for {}, found {}", what, shown(word)));
  if (!std::isfinite(*value)) fail(fmt::format("{} is not finite: {}", what, shown(word)));
  return *value;
}

std::int64_t LineReader::integer(Words& words, std::string_view what) const {
  const std::string_view word = words.next();
  if (word.empty()) fail(fmt::format("line ends where {} is expected", what));
  const auto value = parse_number<std::int64_t>(word);
  if (!value) fail(fmt::format("expected an integer for {}, found {}", what, shown(word)));
  return *value;
}

radiosity::Vec3 LineReader::point(Words& words) const {
  const double x = number(words, "coordinate x");
  const double y = number(words, "coordinate y");
  const double z = number(words, "coordinate z");
  return {x, y, z};
}

}  // namespace io
