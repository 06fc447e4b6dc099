#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace radiosity {

/// A 64-bit hash of everything that was added, in order. Tells apart what differs by accident; not
/// made against forgery.
class Fingerprint {
 public:
  void add(std::span<const std::byte> bytes);
  void add(const std::string& text);
  template <typename T>
  void add(const T& number) {
    add(std::as_bytes(std::span(&number, 1)));
  }
  template <typename T>
  void add(const std::vector<T>& list) {
    add(list.size());
    add(std::as_bytes(std::span(list)));
  }

  [[nodiscard]] std::uint64_t value() const { return hash_; }
  /// As 16 hexadecimal digits.
  [[nodiscard]] std::string text() const;

 private:
  std::uint64_t hash_ = 0x9e3779b97f4a7c15;
};

}  // namespace radiosity
