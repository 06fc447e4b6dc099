#include "apps/cluster/mpi_ranks.h"

#include <mpi.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <stdexcept>
#include <thread>

#include "apps/cluster/heartbeat.h"

namespace apps {
namespace {

using Clock = std::chrono::steady_clock;

/// Bytes that one call moves at most: MPI counts in int.
constexpr std::size_t kMostAtOnce = std::size_t{1} << 30U;
/// How long a waiting rank looks for its message without a pause, and how long it then sleeps each
/// time: who waits long shall not take a core from those that are waited for.
constexpr auto kEager = std::chrono::microseconds(200);
constexpr auto kNap = std::chrono::microseconds(100);
/// How long MPI may take to end all ranks.
constexpr auto kLastWords = std::chrono::seconds(5);

/// Waits until `is_done` tells so or the time is over.
template <typename IsDone>
bool wait_until(RankActivity& activity, const IsDone& is_done,
                Clock::duration time = Clock::duration::max()) {
  const Clock::time_point start = Clock::now();
  ++activity.waiting;
  bool is_late = false;
  while (!is_done()) {
    const Clock::duration waited = Clock::now() - start;
    is_late = waited > time;  // the longest time is for ever
    if (is_late) break;
    if (waited > kEager) std::this_thread::sleep_for(kNap);
  }
  --activity.waiting;
  ++activity.messages;
  return !is_late;
}

bool is_complete(MPI_Request& request) {
  int flag = 0;
  MPI_Test(&request, &flag, MPI_STATUS_IGNORE);
  return flag != 0;
}

}  // namespace

struct MpiRanks::Implementation {
  MPI_Comm channels = MPI_COMM_NULL;  // point to point; the tag is the channel
  MPI_Comm together = MPI_COMM_NULL;  // collective
  MPI_Comm end = MPI_COMM_NULL;
  int rank = 0;
  int size = 1;
  int n_on_machine = 1;
  std::atomic<std::uint64_t> bytes = 0;
  RankActivity activity;
  std::optional<Heartbeat> heartbeat;  // which looks at that
};

MpiRanks::MpiRanks(int& argc, char**& argv) : implementation_(std::make_unique<Implementation>()) {
  int given = 0;
  MPI_Init_thread(&argc, &argv, MPI_THREAD_MULTIPLE, &given);
  if (given < MPI_THREAD_MULTIPLE) {
    throw std::runtime_error("this MPI library does not serve several threads of a process");
  }
  Implementation& own = *implementation_;
  MPI_Comm_dup(MPI_COMM_WORLD, &own.channels);
  MPI_Comm_dup(MPI_COMM_WORLD, &own.together);
  MPI_Comm_dup(MPI_COMM_WORLD, &own.end);
  MPI_Comm_rank(MPI_COMM_WORLD, &own.rank);
  MPI_Comm_size(MPI_COMM_WORLD, &own.size);
  MPI_Comm machine = MPI_COMM_NULL;
  MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, own.rank, MPI_INFO_NULL, &machine);
  MPI_Comm_size(machine, &own.n_on_machine);
  MPI_Comm_free(&machine);
}

MpiRanks::~MpiRanks() {
  implementation_->heartbeat.reset();
  MPI_Finalize();
}

void MpiRanks::watch(std::chrono::duration<double> patience,
                     std::function<void(const std::string& line)> lost) {
  implementation_->heartbeat.emplace(implementation_->activity, patience, std::move(lost));
}

void MpiRanks::set_patience(std::chrono::duration<double> patience) {
  if (implementation_->heartbeat) implementation_->heartbeat->set_patience(patience);
}

int MpiRanks::rank() const { return implementation_->rank; }

int MpiRanks::size() const { return implementation_->size; }

int MpiRanks::n_on_machine() const { return implementation_->n_on_machine; }

std::uint64_t MpiRanks::bytes_moved() const { return implementation_->bytes; }

void MpiRanks::send(int to, radiosity::Channel channel, std::span<const std::byte> bytes) {
  if (bytes.size() > 2 * kMostAtOnce - 1) {
    throw std::runtime_error("a message to another rank is larger than 2 GB");
  }
  MPI_Request request = MPI_REQUEST_NULL;
  MPI_Isend(bytes.data(), static_cast<int>(bytes.size()), MPI_BYTE, to, static_cast<int>(channel),
            implementation_->channels, &request);
  wait_until(implementation_->activity, [&] { return is_complete(request); });
  implementation_->bytes += bytes.size();
}

std::vector<std::byte> MpiRanks::receive(int from, radiosity::Channel channel) {
  MPI_Message message = MPI_MESSAGE_NULL;
  MPI_Status status;
  wait_until(implementation_->activity, [&] {
    int flag = 0;
    MPI_Improbe(from, static_cast<int>(channel), implementation_->channels, &flag, &message,
                &status);
    return flag != 0;
  });
  int n = 0;
  MPI_Get_count(&status, MPI_BYTE, &n);
  std::vector<std::byte> bytes(n);
  MPI_Mrecv(bytes.data(), n, MPI_BYTE, &message, MPI_STATUS_IGNORE);
  implementation_->bytes += bytes.size();
  return bytes;
}

std::optional<radiosity::Ranks::Message> MpiRanks::poll(radiosity::Channel channel) {
  MPI_Message message = MPI_MESSAGE_NULL;
  MPI_Status status;
  int flag = 0;
  MPI_Improbe(MPI_ANY_SOURCE, static_cast<int>(channel), implementation_->channels, &flag, &message,
              &status);
  // A thread that looks again and again without finding any does nothing in between.
  static thread_local std::int64_t time_of_last_in_vain = -1;
  if (flag == 0) {
    const std::int64_t now = thread_time();
    if (time_of_last_in_vain >= 0) implementation_->activity.idle += now - time_of_last_in_vain;
    time_of_last_in_vain = now;
    return std::nullopt;
  }
  time_of_last_in_vain = -1;
  int n = 0;
  MPI_Get_count(&status, MPI_BYTE, &n);
  Message result{status.MPI_SOURCE, std::vector<std::byte>(n)};
  MPI_Mrecv(result.bytes.data(), n, MPI_BYTE, &message, MPI_STATUS_IGNORE);
  implementation_->bytes += result.bytes.size();
  ++implementation_->activity.messages;
  return result;
}

void MpiRanks::broadcast(int from, std::span<std::byte> bytes) {
  for (std::size_t begin = 0; begin < bytes.size(); begin += kMostAtOnce) {
    const std::span<std::byte> piece =
        bytes.subspan(begin, std::min(kMostAtOnce, bytes.size() - begin));
    MPI_Request request = MPI_REQUEST_NULL;
    MPI_Ibcast(piece.data(), static_cast<int>(piece.size()), MPI_BYTE, from,
               implementation_->together, &request);
    wait_until(implementation_->activity, [&] { return is_complete(request); });
  }
  if (size() > 1) implementation_->bytes += bytes.size();
}

bool MpiRanks::end_together(std::chrono::seconds seconds) {
  const Clock::duration time =
      seconds == std::chrono::seconds::max() ? Clock::duration::max() : Clock::duration(seconds);
  MPI_Request request = MPI_REQUEST_NULL;
  MPI_Ibarrier(implementation_->end, &request);
  return wait_until(
      implementation_->activity, [&] { return is_complete(request); }, time);
}

std::pair<std::uint64_t, std::uint64_t> MpiRanks::most_of_all(std::uint64_t a, std::uint64_t b) {
  std::uint64_t values[] = {a, b};
  MPI_Allreduce(MPI_IN_PLACE, values, 2, MPI_UINT64_T, MPI_MAX, implementation_->together);
  return {values[0], values[1]};
}

void MpiRanks::abort(int exit_code) {
  // It may wait for ever for one that hangs.
  std::thread([exit_code] {
    std::this_thread::sleep_for(kLastWords);
    std::_Exit(exit_code);
  }).detach();
  MPI_Abort(MPI_COMM_WORLD, exit_code);
  std::_Exit(exit_code);
}

}  // namespace apps
