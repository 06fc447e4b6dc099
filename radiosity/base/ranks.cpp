#include "radiosity/base/ranks.h"

#include <algorithm>
#include <cstring>

namespace radiosity {
namespace {

/// From rank to rank each adds what it has, and all get what the last one then has.
template <typename Value>
void sum_in_order(Ranks& ranks, std::span<Value> values) {
  const auto bytes = std::as_writable_bytes(values);
  if (ranks.rank() > 0) {
    const std::vector<std::byte> before = ranks.receive(ranks.rank() - 1, Channel::values);
    for (std::size_t k = 0; k < values.size(); ++k) {
      Value sum = 0;
      std::memcpy(&sum, before.data() + k * sizeof(Value), sizeof(Value));
      values[k] = sum + values[k];
    }
  }
  if (ranks.rank() + 1 < ranks.size()) ranks.send(ranks.rank() + 1, Channel::values, bytes);
  ranks.broadcast(ranks.size() - 1, bytes);
}

}  // namespace

void on_first_rank(Ranks* ranks, const std::function<void()>& work) {
  if (ranks == nullptr) return work();
  std::byte is_done{1};
  const std::span<std::byte> told(&is_done, 1);
  if (ranks->rank() == 0) {
    try {
      work();
    } catch (...) {
      is_done = std::byte{0};
      ranks->broadcast(0, told);
      throw;
    }
  }
  ranks->broadcast(0, told);
  if (is_done == std::byte{0}) throw FirstRankFailed();
}

void sum_over_ranks(Ranks& ranks, std::span<std::int64_t> values) { sum_in_order(ranks, values); }

void sum_over_ranks(Ranks& ranks, std::span<double> values) { sum_in_order(ranks, values); }

std::uint64_t least_of_ranks(Ranks& ranks, std::uint64_t value) {
  std::uint64_t least = value;
  for (int rank = 0; rank < ranks.size(); ++rank) {
    std::uint64_t its = value;
    ranks.broadcast(rank, std::as_writable_bytes(std::span(&its, 1)));
    least = std::min(least, its);
  }
  return least;
}

std::vector<std::byte> exchange_with(Ranks& ranks, int partner, std::span<const std::byte> bytes) {
  const bool is_lower = ranks.rank() < partner;
  if (is_lower) ranks.send(partner, Channel::values, bytes);
  std::vector<std::byte> received = ranks.receive(partner, Channel::values);
  if (!is_lower) ranks.send(partner, Channel::values, bytes);
  return received;
}

}  // namespace radiosity
