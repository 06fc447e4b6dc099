#include "io/mesh/msh_source.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>

namespace io {

MshSource::MshSource(const std::filesystem::path& path, const radiosity::Progress& progress)
    : path_(path), progress_(progress), lines_(path, progress), words_("") {
  read_format();
}

void MshSource::fail(const std::string& message) const {
  if (!bytes_) lines_.fail(message);
  io::fail(path_, fmt::format("${}, byte {}: {}", section_, bytes_->offset(), message));
}

void MshSource::read_format() {
  if (!next_section() || section_ != "MeshFormat") {
    fail("is no mesh of Gmsh: expected $MeshFormat");
  }
  lines_.recognise();
  Words words = next_line();
  version_ = lines_.number(words, "the version");
  const bool is_known = (version_ >= 2 && version_ < 3) || (version_ >= 4.1 && version_ < 5);
  if (!is_known) {
    fail(fmt::format("has version {:g}, expected 2 or 4.1 (gmsh -format msh41)", version_));
  }
  is_binary_ = lines_.integer(words, "the kind of file") != 0;
  if (is_binary_) {
    const std::int64_t size = lines_.integer(words, "the size of numbers");
    if (size != 8) fail(fmt::format("has numbers of {} bytes, expected 8", size));
    const std::int64_t one = integer("the number 1");
    if (one != 1 && one != 1 << 24) fail("is in no known order of bytes: expected the number 1");
    if (one != 1) order_ = std::endian::big;
  }
  leave_section();
}

bool MshSource::next_section() {
  while (lines_.next_line()) {
    const std::string_view line = trimmed(lines_.line());
    if (line.starts_with('$')) {
      section_ = line.substr(1);
      return true;
    }
    if (!line.empty()) fail("expected $ and the name of a section");
  }
  return false;
}

void MshSource::leave_section() {
  if (bytes_) {
    lines_.skip_to(bytes_->offset());
    bytes_.reset();
  }
  while (trimmed(lines_.line()) != "$End" + section_) {
    if (!lines_.next_line()) fail(fmt::format("file ends in ${}", section_));
  }
}

Words MshSource::next_line() {
  if (!lines_.next_line()) fail(fmt::format("file ends in ${}", section_));
  return Words(lines_.line());
}

void MshSource::next_record() {
  if (!is_binary_) words_ = next_line();
}

const char* MshSource::take(std::uint64_t n, std::string_view what) {
  if (!bytes_) bytes_.emplace(path_, lines_.offset(), progress_);
  if (n > bytes_->size() - bytes_->offset()) {
    fail(fmt::format("file ends where {} should stand", what));
  }
  return bytes_->take(n);
}

std::int64_t MshSource::integer(std::string_view what) {
  if (!is_binary_) return lines_.integer(words_, what);
  return load<std::int32_t>(take(4, what), order_);
}

std::int64_t MshSource::large(std::string_view what) {
  if (!is_binary_) return lines_.integer(words_, what);
  return load<std::int64_t>(take(8, what), order_);
}

double MshSource::number(std::string_view what) {
  if (!is_binary_) return lines_.number(words_, what);
  const auto value = load<double>(take(8, what), order_);
  if (!std::isfinite(value)) fail(fmt::format("{} is not finite: {}", what, value));
  return value;
}

radiosity::Vec3 MshSource::point() {
  if (!is_binary_) return lines_.point(words_);
  const double x = number("coordinate x");
  const double y = number("coordinate y");
  return {x, y, number("coordinate z")};
}

std::uint64_t MshSource::count(std::string_view what, std::uint64_t bytes_each) {
  return checked_count(large(what), what, bytes_each);
}

std::uint64_t MshSource::count(Words& words, std::string_view what, std::uint64_t bytes_each) {
  return checked_count(lines_.integer(words, what), what, bytes_each);
}

std::uint64_t MshSource::checked_count(std::int64_t n, std::string_view what,
                                       std::uint64_t bytes_each) {
  if (n < 0) fail(fmt::format("found {} as {}, expected 0 or more", n, what));
  const auto found = static_cast<std::uint64_t>(n);
  const std::uint64_t left = lines_.size() - (bytes_ ? bytes_->offset() : lines_.offset());
  if (is_binary_ && found > left / bytes_each) {
    fail(fmt::format("file ends in ${}: found {} as {}, but {} bytes are left", section_, n, what,
                     left));
  }
  return found;
}

}  // namespace io
