#include "io/vtp_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>

#include "io/byte_reader.h"
#include "io/line_reader.h"

namespace io {
namespace {

/// zlib makes no block smaller than this part of it (1032, and some slack for short ones).
constexpr std::uint64_t kMostCompressed = 1100;

constexpr auto kTypes =
    std::to_array<std::string_view>({"Int8", "UInt8", "Int16", "UInt16", "Int32", "UInt32", "Int64",
                                     "UInt64", "Float32", "Float64", "String"});

class VtpCheck {
 public:
  explicit VtpCheck(const std::filesystem::path& path)
      : path_(path), size_(input_size(path)), stream_(path, std::ios::binary) {
    if (!stream_) fail(path_, "cannot be read");
  }

  void run() {
    read_head();
    const std::string_view root = find_tag("<VTKFile", 0);
    if (root.empty()) fail(path_, "is not a .vtp file (VTK XML)");
    if (attribute(root, "type") != "PolyData") {
      fail(path_, "is a VTK file of another kind, expected PolyData (.vtp)");
    }
    check_end();
    read_layout(root);
    check_arrays("<DataArray");
    check_arrays("<Array");
  }

 private:
  [[noreturn]] void damaged(const std::string& what) const { fail(path_, "is damaged: " + what); }

  /// All up to the binary data at the end, if there are any.
  void read_head() {
    constexpr std::size_t kStep = 1 << 16;
    std::string piece(kStep, '\0');
    std::size_t searched = 0;
    while (stream_ && head_.find(kAppended, searched) == std::string::npos) {
      searched = head_.size() - std::min(head_.size(), kAppended.size());
      stream_.read(piece.data(), kStep);
      head_.append(piece.data(), static_cast<std::size_t>(stream_.gcount()));
      // A file that is something else need not be read on.
      if (head_.size() <= kStep && head_.find("<VTKFile") == std::string::npos) return;
    }
    stream_.clear();
  }

  /// VTK takes a file whose end is missing for one without those data.
  void check_end() {
    std::string tail(std::min<std::uint64_t>(size_, 256), '\0');
    (void)read(size_ - tail.size(), tail.data(), tail.size());
    if (tail.find("</VTKFile>") == std::string::npos) {
      fail(path_, "is cut off: it ends before its </VTKFile>");
    }
  }

  void read_layout(std::string_view root) {
    const auto header = attribute(root, "header_type").value_or("UInt32");
    if (header != "UInt32" && header != "UInt64") damaged("unknown header_type");
    word_ = header == "UInt64" ? 8 : 4;
    const auto order = attribute(root, "byte_order").value_or("LittleEndian");
    order_ = order == "BigEndian" ? std::endian::big : std::endian::little;
    compressor_ = attribute(root, "compressor").value_or("");
    const std::size_t appended = head_.find(kAppended);
    if (appended == std::string::npos) return;
    const std::string_view tag = find_tag(kAppended, appended);
    const auto encoding = attribute(tag, "encoding");
    if (encoding != "raw" && encoding != "base64") damaged("unknown encoding");
    has_data_ = true;
    if (encoding != "raw") return;
    const std::size_t start = head_.find('_', appended + tag.size());
    if (tag.empty() || start == std::string::npos) damaged("its data have no beginning");
    data_ = start + 1;
    head_.resize(appended);
  }

  void check_arrays(std::string_view name) const {
    for (std::size_t place = head_.find(name); place != std::string::npos;
         place = head_.find(name, place + 1)) {
      const std::string_view tag = find_tag(name, place);
      const std::string label(attribute(tag, "Name").value_or("?"));
      const auto type = attribute(tag, "type").value_or("");
      if (std::find(kTypes.begin(), kTypes.end(), type) == kTypes.end()) {
        damaged(fmt::format("array \"{}\" has the type \"{}\"", label, type));
      }
      check_count(tag, "NumberOfComponents", label);
      check_count(tag, "NumberOfTuples", label);
      if (attribute(tag, "format") != "appended") continue;
      if (!has_data_) damaged(fmt::format("the data of array \"{}\" are missing", label));
      if (data_ == 0) continue;
      const auto offset = parse_number<std::uint64_t>(attribute(tag, "offset").value_or(""));
      if (!offset || *offset >= size_ || !is_block(data_ + *offset)) {
        damaged(fmt::format("the data of array \"{}\" are not where they should be", label));
      }
    }
  }

  /// What is no number VTK takes for any.
  void check_count(std::string_view tag, std::string_view name, const std::string& label) const {
    const auto count = attribute(tag, name);
    if (!count) return;
    const auto number = parse_number<std::int32_t>(*count);
    if (!number || *number < 0) {
      damaged(fmt::format("array \"{}\" has the {} \"{}\"", label, name, *count));
    }
  }

  /// Whether the lengths that stand at `place` may be those of data in this file.
  [[nodiscard]] bool is_block(std::uint64_t place) const {
    if (compressor_.empty()) {
      const auto bytes = word(place);
      return bytes && *bytes <= size_ && place + word_ + *bytes <= size_;
    }
    const auto n_blocks = word(place);
    if (!n_blocks) return false;
    if (*n_blocks == 0) return true;
    const auto block = word(place + word_);
    const auto last_block = word(place + 2 * word_);
    if (!block || !last_block || *last_block > *block || *n_blocks > size_ / word_) return false;
    std::uint64_t packed = 0;
    for (std::uint64_t k = 0; k < *n_blocks; ++k) {
      const auto bytes = word(place + (3 + k) * word_);
      if (!bytes || *bytes > size_) return false;
      packed += *bytes;
      if (compressor_ == "vtkZLibDataCompressor" && *block / kMostCompressed > *bytes &&
          k + 1 < *n_blocks) {
        return false;
      }
    }
    if (packed > size_ || place + (3 + *n_blocks) * word_ + packed > size_) return false;
    return compressor_ != "vtkZLibDataCompressor" || *block <= kMostCompressed * size_;
  }

  /// The length at a place of the file; nothing beyond its end.
  [[nodiscard]] std::optional<std::uint64_t> word(std::uint64_t place) const {
    std::array<char, 8> bytes{};
    if (place > size_ || !read(place, bytes.data(), word_)) return std::nullopt;
    return word_ == 8 ? load<std::uint64_t>(bytes.data(), order_)
                      : load<std::uint32_t>(bytes.data(), order_);
  }

  bool read(std::uint64_t place, char* bytes, std::size_t n) const {
    stream_.clear();
    stream_.seekg(static_cast<std::streamoff>(place));
    return static_cast<bool>(stream_.read(bytes, static_cast<std::streamsize>(n)));
  }

  /// The tag that starts with `name` at `start` or behind, without its end; empty if there is none.
  [[nodiscard]] std::string_view find_tag(std::string_view name, std::size_t start) const {
    const std::size_t first = head_.find(name, start);
    if (first == std::string::npos) return {};
    bool is_quoted = false;
    for (std::size_t k = first; k < head_.size(); ++k) {
      if (head_[k] == '"') is_quoted = !is_quoted;
      if (head_[k] == '>' && !is_quoted) return std::string_view(head_).substr(first, k - first);
    }
    return {};
  }

  static std::optional<std::string_view> attribute(std::string_view tag, std::string_view name) {
    const std::string start = fmt::format(" {}=\"", name);
    const std::size_t first = tag.find(start);
    if (first == std::string_view::npos) return std::nullopt;
    const std::string_view rest = tag.substr(first + start.size());
    return rest.substr(0, rest.find('"'));
  }

  static constexpr std::string_view kAppended = "<AppendedData";

  const std::filesystem::path& path_;
  std::uint64_t size_;
  mutable std::ifstream stream_;
  std::string head_;
  std::string compressor_;
  std::endian order_ = std::endian::little;
  std::size_t word_ = 4;    // bytes of a length
  bool has_data_ = false;   // appended, raw or not
  std::uint64_t data_ = 0;  // where raw appended data start; 0 = there are none
};

}  // namespace

void check_vtp(const std::filesystem::path& path) { VtpCheck(path).run(); }

}  // namespace io
