#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <stdexcept>
#include <vector>

namespace radiosity {

/// What a message between ranks is about. Messages of one channel between two ranks keep their
/// order.
enum class Channel : int { values, tiles };

/// The processes that work on one problem, each with a copy of the patches. All run the same
/// program on the same input, so that they ask for the same sums in the same order. Whatever cannot
/// reach another rank throws std::runtime_error or ends the program.
class Ranks {
 public:
  struct Message {
    int from = 0;
    std::vector<std::byte> bytes;
  };

  virtual ~Ranks() = default;
  /// Number of this process, 0 <= rank < size.
  [[nodiscard]] virtual int rank() const = 0;
  [[nodiscard]] virtual int size() const = 0;
  /// How many of them share this machine's memory.
  [[nodiscard]] virtual int n_on_machine() const = 0;
  /// Sends bytes, 2 GB at most, to another rank. Callable from any thread.
  virtual void send(int to, Channel channel, std::span<const std::byte> bytes) = 0;
  /// Waits for the next message of a rank.
  [[nodiscard]] virtual std::vector<std::byte> receive(int from, Channel channel) = 0;
  /// The next message of any rank, if one is there. From one thread at a time in each channel.
  [[nodiscard]] virtual std::optional<Message> poll(Channel channel) = 0;
  /// Fills `bytes`, as many on every rank, with those of rank `from`. On one thread.
  virtual void broadcast(int from, std::span<std::byte> bytes) = 0;
  /// Bytes that this one has sent and received so far.
  [[nodiscard]] virtual std::uint64_t bytes_moved() const = 0;

  /// What products with operators that lie on all ranks have moved so far, on this one.
  struct ProductTraffic {
    std::uint64_t products = 0;
    std::uint64_t bytes = 0;  ///< sent and received
  };
  [[nodiscard]] ProductTraffic product_traffic() const { return {products_, product_bytes_}; }

 private:
  friend class CountedProduct;
  std::atomic<std::uint64_t> products_ = 0;
  std::atomic<std::uint64_t> product_bytes_ = 0;
};

/// Counts a product of all ranks for as long as it lives. Nothing else is sent meanwhile.
class CountedProduct {
 public:
  /// `ranks` may be null: nothing is counted.
  explicit CountedProduct(Ranks* ranks)
      : ranks_(ranks), before_(ranks != nullptr ? ranks->bytes_moved() : 0) {}
  ~CountedProduct() {
    if (ranks_ == nullptr) return;
    ++ranks_->products_;
    ranks_->product_bytes_ += ranks_->bytes_moved() - before_;
  }
  CountedProduct(const CountedProduct&) = delete;
  CountedProduct& operator=(const CountedProduct&) = delete;

 private:
  Ranks* ranks_;
  std::uint64_t before_;
};

/// Thrown on the other ranks where the first has failed, which tells why.
struct FirstRankFailed : std::runtime_error {
  FirstRankFailed() : std::runtime_error("the first rank has failed") {}
};

/// Whether this is the one that reads, writes and tells: the only one, perhaps (null).
inline bool is_first(const Ranks* ranks) { return ranks == nullptr || ranks->rank() == 0; }

/// Does `work` on the first rank while all others wait; where it throws there, they throw
/// FirstRankFailed.
void on_first_rank(Ranks* ranks, const std::function<void()>& work);

/// Σ over all ranks, exactly, on every rank.
void sum_over_ranks(Ranks& ranks, std::span<std::int64_t> values);
/// The same of values of which each is 0 on all ranks but one, or added in the order of the ranks.
void sum_over_ranks(Ranks& ranks, std::span<double> values);
/// The least of all ranks' values.
std::uint64_t least_of_ranks(Ranks& ranks, std::uint64_t value);

/// Sends bytes to another rank that calls this, too, and returns what it sends.
std::vector<std::byte> exchange_with(Ranks& ranks, int partner, std::span<const std::byte> bytes);

/// Where the share of a rank of n things begins that are divided among the ranks in their order;
/// that of rank `size` is n.
inline std::ptrdiff_t share_begin(std::ptrdiff_t n, int rank, int size) { return n * rank / size; }

}  // namespace radiosity
