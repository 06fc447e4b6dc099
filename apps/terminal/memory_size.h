#pragma once

#include <cstddef>
#include <optional>
#include <string>

namespace apps {

/// The bytes that "2GB", "500 MB", "1.5G", "750MiB" or "1000000" tell; nothing if the text is no
/// such size or less than one byte. k, M, G, T are powers of 1000; Ki, Mi, Gi, Ti of 1024. Case
/// does not matter, nor does the B. Reads what radiosity::memory_text writes.
std::optional<std::size_t> parse_memory_size(const std::string& text);

/// For the command line's check: empty if the text is such a size, else what was found.
std::string check_memory_size(const std::string& text);

}  // namespace apps
