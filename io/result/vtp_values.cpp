#include "io/result/vtp_values.h"

#include <algorithm>
#include <array>
#include <utility>

#include "io/base/line_reader.h"

namespace io {
namespace {

constexpr std::array<std::pair<std::string_view, std::size_t>, 11> kTypes = {{{"Int8", 1},
                                                                              {"UInt8", 1},
                                                                              {"Int16", 2},
                                                                              {"UInt16", 2},
                                                                              {"Int32", 4},
                                                                              {"UInt32", 4},
                                                                              {"Int64", 8},
                                                                              {"UInt64", 8},
                                                                              {"Float32", 4},
                                                                              {"Float64", 8},
                                                                              {"String", 1}}};

template <typename T>
bool append_number(std::string_view word, std::string& bytes) {
  const auto value = parse_number<T>(word);
  if (!value) return false;
  bytes.append(reinterpret_cast<const char*>(&*value), sizeof(T));
  return true;
}

}  // namespace

std::size_t vtp_type_size(const std::string& type) {
  const auto* const entry = std::find_if(kTypes.begin(), kTypes.end(),
                                         [&](const auto& known) { return known.first == type; });
  return entry == kTypes.end() ? 0 : entry->second;
}

bool append_value(std::string_view word, const std::string& type, std::string& bytes) {
  if (type == "Int8") return append_number<std::int8_t>(word, bytes);
  // Of texts VTK writes the letters' codes, signed.
  if (type == "String" && word.starts_with('-')) return append_number<std::int8_t>(word, bytes);
  if (type == "UInt8" || type == "String") return append_number<std::uint8_t>(word, bytes);
  if (type == "Int16") return append_number<std::int16_t>(word, bytes);
  if (type == "UInt16") return append_number<std::uint16_t>(word, bytes);
  if (type == "Int32") return append_number<std::int32_t>(word, bytes);
  if (type == "UInt32") return append_number<std::uint32_t>(word, bytes);
  if (type == "Int64") return append_number<std::int64_t>(word, bytes);
  if (type == "UInt64") return append_number<std::uint64_t>(word, bytes);
  return type == "Float32" ? append_number<float>(word, bytes) : append_number<double>(word, bytes);
}

void reverse_bytes(std::string& bytes, std::size_t size) {
  for (std::size_t k = 0; k + size <= bytes.size(); k += size) {
    std::reverse(bytes.begin() + static_cast<std::ptrdiff_t>(k),
                 bytes.begin() + static_cast<std::ptrdiff_t>(k + size));
  }
}

}  // namespace io
