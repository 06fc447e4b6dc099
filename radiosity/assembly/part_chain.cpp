#include "radiosity/assembly/part_chain.h"

#include <algorithm>
#include <cstring>

namespace radiosity {
namespace {

/// Values of a piece: so few that the next rank need not wait long, so many that messages cost
/// little.
constexpr std::size_t kPiece = 16384;

}  // namespace

void add_along_ranks(Ranks& ranks, const SumParts& parts, const std::vector<const double*>& own,
                     std::span<double> sum) {
  // Only ranks that have parts take part in the chain; there may be fewer parts than ranks.
  int before = -1;
  int after = -1;
  int last = 0;
  for (int rank = 0; rank < ranks.size(); ++rank) {
    const auto [first, end] = parts.share(rank, ranks.size());
    if (first == end) continue;
    if (rank < ranks.rank()) before = rank;
    if (rank > ranks.rank() && after < 0) after = rank;
    last = rank;
  }
  for (std::size_t begin = 0; begin < sum.size() && !own.empty(); begin += kPiece) {
    const std::span<double> piece = sum.subspan(begin, std::min(kPiece, sum.size() - begin));
    std::size_t part = 0;
    if (before >= 0) {
      const std::vector<std::byte> bytes = ranks.receive(before, Channel::values);
      std::memcpy(piece.data(), bytes.data(), piece.size_bytes());
    } else {
      std::copy_n(own[part++] + begin, piece.size(), piece.data());
    }
    for (; part < own.size(); ++part) {
      for (std::size_t k = 0; k < piece.size(); ++k) piece[k] += own[part][begin + k];
    }
    if (after >= 0) ranks.send(after, Channel::values, std::as_bytes(piece));
  }
  ranks.broadcast(last, std::as_writable_bytes(sum));
}

}  // namespace radiosity
