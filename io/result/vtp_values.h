#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

namespace io {

/// An array of a VTK file.
struct VtpArray {
  std::string type;                ///< VTK's name: "Float64", "Int32", "String"...
  std::uint64_t n_components = 1;  ///< values in a row
  std::string bytes;               ///< the values, row by row, as this machine has them; of texts
                                   ///< the characters, a zero byte after each
};

/// Bytes of a value of VTK's type of this name; 0 if there is none. 1 for texts.
std::size_t vtp_type_size(const std::string& type);

/// Appends the value of VTK's type that the word spells; false if it spells none. Of texts a word
/// is the code of a letter.
bool append_value(std::string_view word, const std::string& type, std::string& bytes);

/// Turns the bytes of values of `size` bytes each from one order into the other.
void reverse_bytes(std::string& bytes, std::size_t size);

/// The k-th value of an array of T.
template <typename T, typename As>
As value_at(const VtpArray& array, std::size_t k) {
  T value{};
  std::memcpy(&value, array.bytes.data() + k * sizeof(T), sizeof(T));
  return static_cast<As>(value);
}

/// The k-th value of an array of numbers, which is there.
template <typename As>
As number(const VtpArray& array, std::size_t k) {
  const std::string& type = array.type;
  if (type == "Int8") return value_at<std::int8_t, As>(array, k);
  if (type == "UInt8") return value_at<std::uint8_t, As>(array, k);
  if (type == "Int16") return value_at<std::int16_t, As>(array, k);
  if (type == "UInt16") return value_at<std::uint16_t, As>(array, k);
  if (type == "Int32") return value_at<std::int32_t, As>(array, k);
  if (type == "UInt32") return value_at<std::uint32_t, As>(array, k);
  if (type == "Int64") return value_at<std::int64_t, As>(array, k);
  if (type == "UInt64") return value_at<std::uint64_t, As>(array, k);
  if (type == "Float32") return value_at<float, As>(array, k);
  return value_at<double, As>(array, k);
}

/// Whether an array has whole numbers, one in a row.
inline bool is_whole(const VtpArray& array) {
  return !array.type.starts_with("Float") && array.type != "String" && array.n_components == 1;
}

/// Values, in all rows.
inline std::size_t n_values(const VtpArray& array) {
  return array.bytes.size() / vtp_type_size(array.type);
}

}  // namespace io
