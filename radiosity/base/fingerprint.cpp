#include "radiosity/base/fingerprint.h"

#include <cstring>
#include <iomanip>
#include <sstream>

namespace radiosity {
namespace {

std::uint64_t mix(std::uint64_t hash, std::uint64_t word) {
  constexpr std::uint64_t kFactor = 0xff51afd7ed558ccd;
  hash = (hash ^ word) * kFactor;
  return hash ^ (hash >> 32);
}

}  // namespace

void Fingerprint::add(std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const std::size_t n = bytes.size() < 8 ? bytes.size() : 8;
    std::uint64_t word = 0;
    std::memcpy(&word, bytes.data(), n);
    hash_ = mix(hash_, word);
    bytes = bytes.subspan(n);
  }
}

void Fingerprint::add(const std::string& text) {
  add(text.size());
  add(std::as_bytes(std::span(text)));
}

std::string Fingerprint::text() const {
  std::ostringstream stream;
  stream << std::hex << std::setw(16) << std::setfill('0') << hash_;
  return stream.str();
}

}  // namespace radiosity
