#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "radiosity/base/ranks.h"

namespace apps {

/// The processes that mpirun has started, by MPI, which lives as long as this. Make one at the
/// start of `main`, after what watches signals. Throws std::runtime_error if MPI cannot serve
/// several threads.
class MpiRanks final : public radiosity::Ranks {
 public:
  MpiRanks(int& argc, char**& argv);
  ~MpiRanks() override;
  MpiRanks(const MpiRanks&) = delete;
  MpiRanks& operator=(const MpiRanks&) = delete;

  [[nodiscard]] int rank() const override;
  [[nodiscard]] int size() const override;
  void send(int to, radiosity::Channel channel, std::span<const std::byte> bytes) override;
  [[nodiscard]] std::vector<std::byte> receive(int from, radiosity::Channel channel) override;
  [[nodiscard]] std::optional<Message> poll(radiosity::Channel channel) override;
  void broadcast(int from, std::span<std::byte> bytes) override;

  [[nodiscard]] int n_on_machine() const override;
  [[nodiscard]] std::uint64_t bytes_moved() const override;

  /// From now on ranks tell each other that they live. `lost` is called on a thread of its own,
  /// with one line, if one has not for as long as the patience (0: for ever), or none gets on, and
  /// shall end them all. Once, by all together.
  void watch(std::chrono::duration<double> patience,
             std::function<void(const std::string& line)> lost);
  void set_patience(std::chrono::duration<double> patience);

  /// Waits at the end until all ranks have come here; false if they have not in time.
  [[nodiscard]] bool end_together(std::chrono::seconds time);
  /// The largest of all ranks' values, of each of the two; called by all together.
  [[nodiscard]] std::pair<std::uint64_t, std::uint64_t> most_of_all(std::uint64_t a,
                                                                    std::uint64_t b);
  /// Ends all ranks at once.
  [[noreturn]] void abort(int exit_code);

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace apps
