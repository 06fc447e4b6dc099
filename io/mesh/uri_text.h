#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace io {

/// The bytes that base64 (RFC 4648, either alphabet) stands for; empty if it is none.
std::optional<std::string> decode_base64(std::string_view text);

/// "a%20b.bin" is "a b.bin".
std::string decode_percent(std::string_view uri);

}  // namespace io
