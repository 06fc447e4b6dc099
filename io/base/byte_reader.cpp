#include "io/base/byte_reader.h"

#include <fmt/format.h>

#include <algorithm>

#include "io/base/line_reader.h"

namespace io {
namespace {

constexpr std::size_t kByteBufferSize = 1 << 16;

}  // namespace

ByteReader::ByteReader(const std::filesystem::path& path, std::uint64_t offset,
                       const radiosity::Progress& progress)
    : path_(path),
      progress_(progress),
      size_(input_size(path)),
      offset_(offset),
      file_(path, std::ios::binary),
      buffer_(kByteBufferSize) {
  file_.seekg(static_cast<std::streamoff>(offset));
}

const char* ByteReader::take(std::uint64_t n) {
  // Compared before anything is allocated: n may come from a damaged file. Written as a
  // difference, which cannot overflow.
  if (n > size_ - std::min(offset_, size_)) {
    fail(path_, fmt::format("is truncated: found {} bytes, expected at least {}", size_,
                            static_cast<double>(offset_) + static_cast<double>(n)));
  }
  if (end_ - begin_ < n) refill(n);
  const char* bytes = buffer_.data() + begin_;
  begin_ += n;
  offset_ += n;
  return bytes;
}

void ByteReader::refill(std::uint64_t n) {
  progress_.check();
  if (progress_.report) {
    progress_.report("reading", static_cast<double>(offset_), static_cast<double>(size_), "bytes");
  }
  std::memmove(buffer_.data(), buffer_.data() + begin_, end_ - begin_);
  end_ -= begin_;
  begin_ = 0;
  if (buffer_.size() < n) buffer_.resize(n);
  file_.read(buffer_.data() + end_, static_cast<std::streamsize>(buffer_.size() - end_));
  end_ += static_cast<std::size_t>(file_.gcount());
  if (end_ < n) fail(path_, "cannot be read to its end");
}

}  // namespace io
