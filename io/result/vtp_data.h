#pragma once

#include <bit>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace io {

/// How a VTK XML file stores the values of its arrays.
struct VtpEncoding {
  std::endian order = std::endian::little;
  std::size_t word = 4;      ///< bytes of each length that stands before values, 4 or 8
  std::string compressor{};  ///< VTK's class; empty = not compressed
};

/// Takes the next bytes of where values are stored; false if they are not there.
using VtpSource = std::function<bool(char* bytes, std::size_t n)>;

/// The next bytes of a text in base64, in which padding may stand anywhere. `text` must outlive it.
VtpSource base64_source(std::string_view text);

/// Reads what stands at a source: lengths, then values, which may be compressed in blocks. All
/// lengths are checked before anything is allocated. `n_bytes` is how many there must be (any
/// number if absent) and `most` how many may be. Empty if they are not there or damaged.
std::optional<std::string> read_vtp_data(const VtpSource& source, const VtpEncoding& encoding,
                                         std::optional<std::uint64_t> n_bytes, std::uint64_t most);

/// Whether `read_vtp_data` knows this compressor ("" is none).
bool is_known_compressor(std::string_view name);

}  // namespace io
