#include "io/result/elmer_factors.h"

#include <fmt/format.h>

#include <bit>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <string>

#include "io/base/atomic_file.h"

namespace io {
namespace {

/// Appends the bytes of a number, least byte first.
template <typename Bits, typename T>
void append_bytes(T value, std::string& bytes) {
  const auto bits = std::bit_cast<Bits>(value);
  for (unsigned shift = 0; shift < 8 * sizeof(Bits); shift += 8) {
    bytes += static_cast<char>(bits >> shift);
  }
}

void append_integer(radiosity::Index value, std::string& bytes) {
  append_bytes<std::uint32_t>(static_cast<std::int32_t>(value), bytes);
}

std::string text_row(radiosity::Index i, const Eigen::VectorXd& row) {
  std::string text = fmt::format("{}\n", (row.array() != 0).count());
  for (radiosity::Index j = 0; j < row.size(); ++j) {
    if (row[j] != 0) fmt::format_to(std::back_inserter(text), "{} {} {}\n", i + 1, j + 1, row[j]);
  }
  return text;
}

std::string binary_row(const Eigen::VectorXd& row) {
  std::string bytes;
  append_integer((row.array() != 0).count(), bytes);
  for (radiosity::Index j = 0; j < row.size(); ++j) {
    if (row[j] == 0) continue;
    append_integer(j + 1, bytes);
    append_bytes<std::uint64_t>(row[j], bytes);
  }
  return bytes;
}

}  // namespace

void write_elmer_factors(const std::filesystem::path& path, const ElementRows& rows,
                         ElmerFile kind) {
  write_stream_atomically(path, [&](std::ofstream& stream) {
    if (kind == ElmerFile::binary) {
      std::string head;
      append_integer(rows.n_elements, head);
      stream << head;
    }
    rows.visit([&](radiosity::Index i, const Eigen::VectorXd& row) {
      stream << (kind == ElmerFile::binary ? binary_row(row) : text_row(i, row));
    });
  });
}

}  // namespace io
