#include "io/result/vtp_data.h"

#include <vtkDataCompressor.h>
#include <vtkLZ4DataCompressor.h>
#include <vtkSmartPointer.h>
#include <vtkZLibDataCompressor.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "io/base/byte_reader.h"

namespace io {
namespace {

constexpr std::string_view kZLib = "vtkZLibDataCompressor";
constexpr std::string_view kLz4 = "vtkLZ4DataCompressor";

/// Neither makes anything smaller than this part of it (1032 and 255, and some slack).
constexpr std::uint64_t kMostCompressed = 1100;

vtkSmartPointer<vtkDataCompressor> make_compressor(std::string_view name) {
  if (name == kZLib) return vtkSmartPointer<vtkZLibDataCompressor>::New();
  return vtkSmartPointer<vtkLZ4DataCompressor>::New();
}

int base64_digit(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  if (c == '+') return 62;
  return c == '/' ? 63 : -1;
}

class Base64 {
 public:
  explicit Base64(std::string_view text) : text_(text) {}

  bool take(char* bytes, std::size_t n) {
    for (std::size_t k = 0; k < n; ++k) {
      if (next_ == size_ && !decode_group()) return false;
      bytes[k] = group_[next_++];
    }
    return true;
  }

 private:
  /// Four digits are three bytes; one or two = at the end stand for bytes that are not there.
  bool decode_group() {
    std::uint32_t bits = 0;
    int n_digits = 0;
    int n_padding = 0;
    for (int k = 0; k < 4; ++k) {
      while (!text_.empty() && static_cast<unsigned char>(text_.front()) <= ' ') {
        text_.remove_prefix(1);
      }
      if (text_.empty()) return false;
      const char c = text_.front();
      const int digit = base64_digit(c);
      if (digit < 0 && (c != '=' || k < 2)) return false;
      if (digit >= 0 && n_padding > 0) return false;
      bits = bits << 6 | static_cast<std::uint32_t>(std::max(digit, 0));
      (digit < 0 ? n_padding : n_digits) += 1;
      text_.remove_prefix(1);
    }
    for (int k = 0; k < 3; ++k) group_[k] = static_cast<char>(bits >> (16 - 8 * k) & 0xFF);
    size_ = n_digits - 1;
    next_ = 0;
    return true;
  }

  std::string_view text_;
  char group_[3] = {};
  int next_ = 0;
  int size_ = 0;
};

std::optional<std::uint64_t> read_word(const VtpSource& source, const VtpEncoding& encoding) {
  char bytes[8] = {};
  if (!source(bytes, encoding.word)) return std::nullopt;
  return encoding.word == 8 ? load<std::uint64_t>(bytes, encoding.order)
                            : load<std::uint32_t>(bytes, encoding.order);
}

bool is_allowed(std::uint64_t found, std::optional<std::uint64_t> n_bytes, std::uint64_t most) {
  return found <= most && (!n_bytes || found == *n_bytes);
}

/// The bytes of a source, in steps, so that a length that is wrong costs no more than there is.
std::optional<std::string> take(const VtpSource& source, std::uint64_t n) {
  constexpr std::uint64_t kStep = 1 << 20;
  std::string bytes;
  while (bytes.size() < n) {
    const std::size_t before = bytes.size();
    bytes.resize(before + std::min(kStep, n - before));
    if (!source(bytes.data() + before, bytes.size() - before)) return std::nullopt;
  }
  return bytes;
}

/// Sizes of the blocks of compressed values: as they are, and as they are stored.
struct Blocks {
  std::vector<std::uint64_t> sizes;
  std::vector<std::uint64_t> stored;
};

std::optional<Blocks> read_blocks(const VtpSource& source, const VtpEncoding& encoding,
                                  std::optional<std::uint64_t> n_bytes, std::uint64_t most) {
  const auto n_blocks = read_word(source, encoding);
  if (!n_blocks) return std::nullopt;
  if (*n_blocks == 0) return is_allowed(0, n_bytes, most) ? std::optional(Blocks{}) : std::nullopt;
  const auto size = read_word(source, encoding);
  const auto last = read_word(source, encoding);
  if (!size || !last || *last > *size || *size == 0 || *n_blocks > most / *size + 1) {
    return std::nullopt;
  }
  const std::uint64_t last_size = *last == 0 ? *size : *last;
  if (!is_allowed((*n_blocks - 1) * *size + last_size, n_bytes, most)) return std::nullopt;
  Blocks blocks;
  for (std::uint64_t k = 0; k < *n_blocks; ++k) {
    const auto stored = read_word(source, encoding);
    blocks.sizes.push_back(k + 1 < *n_blocks ? *size : last_size);
    // Incompressible values take a little more than they are.
    if (!stored || *stored > 2 * blocks.sizes.back() + 1024 ||
        *stored < blocks.sizes.back() / kMostCompressed) {
      return std::nullopt;
    }
    blocks.stored.push_back(*stored);
  }
  return blocks;
}

std::optional<std::string> read_compressed(const VtpSource& source, const VtpEncoding& encoding,
                                           std::optional<std::uint64_t> n_bytes,
                                           std::uint64_t most) {
  const auto blocks = read_blocks(source, encoding, n_bytes, most);
  if (!blocks) return std::nullopt;
  const auto compressor = make_compressor(encoding.compressor);
  std::string result;
  for (std::size_t k = 0; k < blocks->sizes.size(); ++k) {
    const auto stored = take(source, blocks->stored[k]);
    if (!stored) return std::nullopt;
    const std::size_t before = result.size();
    result.resize(before + blocks->sizes[k]);
    const std::size_t size = compressor->Uncompress(
        reinterpret_cast<const unsigned char*>(stored->data()), stored->size(),
        reinterpret_cast<unsigned char*>(result.data() + before), blocks->sizes[k]);
    if (size != blocks->sizes[k]) return std::nullopt;
  }
  return result;
}

}  // namespace

VtpSource base64_source(std::string_view text) {
  return [decoder = std::make_shared<Base64>(text)](char* bytes, std::size_t n) {
    return decoder->take(bytes, n);
  };
}

bool is_known_compressor(std::string_view name) {
  return name.empty() || name == kZLib || name == kLz4;
}

std::optional<std::string> read_vtp_data(const VtpSource& source, const VtpEncoding& encoding,
                                         std::optional<std::uint64_t> n_bytes, std::uint64_t most) {
  if (!encoding.compressor.empty()) return read_compressed(source, encoding, n_bytes, most);
  const auto size = read_word(source, encoding);
  if (!size || !is_allowed(*size, n_bytes, most)) return std::nullopt;
  return take(source, *size);
}

}  // namespace io
