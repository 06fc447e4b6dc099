#include "apps/cluster/heartbeat.h"

#include <mpi.h>
#include <sys/resource.h>
#include <time.h>

#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include "apps/cluster/rank_watch.h"

namespace apps {
namespace {

using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

constexpr auto kBeat = std::chrono::milliseconds(500);
/// Processor time for each second without which a rank stands still: it waits for a disk, say.
constexpr double kLeastWork = 1e-3;
/// What counts of the time between two beats: who was stopped itself, as by a scheduler that
/// suspends the job, does not blame the others.
constexpr auto kLongestBeat = 4 * kBeat;

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

/// Processor time of all threads but this one.
double work_of_others() {
  rusage use{};
  getrusage(RUSAGE_SELF, &use);
  return seconds(use.ru_utime) + seconds(use.ru_stime) - 1e-9 * static_cast<double>(thread_time());
}

/// A beat on its way to another rank.
struct Sent {
  MPI_Request request = MPI_REQUEST_NULL;
  std::uint64_t progress = 0;
};

}  // namespace

std::int64_t thread_time() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return std::int64_t{1'000'000'000} * time.tv_sec + time.tv_nsec;
}

struct Heartbeat::Implementation {
  const RankActivity& activity;
  std::function<void(const std::string&)> lost;
  std::atomic<double> patience;
  MPI_Comm beats = MPI_COMM_NULL;
  int rank = 0;
  int size = 1;
  std::uint64_t progress = 0;
  std::uint64_t messages = 0;
  double work = 0;
  std::vector<Sent> sent;
  std::jthread thread;

  Implementation(const RankActivity& its, Seconds time, std::function<void(const std::string&)> end)
      : activity(its), lost(std::move(end)), patience(time.count()) {
    MPI_Comm_dup(MPI_COMM_WORLD, &beats);
    MPI_Comm_rank(beats, &rank);
    MPI_Comm_size(beats, &size);
    sent.resize(size);
    if (size > 1) thread = std::jthread([this](const std::stop_token& stop) { run(stop); });
  }

  void run(const std::stop_token& stop) {
    RankWatch watch(rank, size);
    std::mutex mutex;
    std::unique_lock lock(mutex);
    std::condition_variable_any never;
    for (Clock::time_point last = Clock::now(); !stop.stop_requested();) {
      never.wait_for(lock, stop, kBeat, [] { return false; });
      const Clock::duration time = std::min<Clock::duration>(Clock::now() - last, kLongestBeat);
      last = Clock::now();
      look_at_own_work(Seconds(time).count());
      tell();
      watch.set_patience(std::chrono::duration_cast<RankWatch::Duration>(Seconds(patience)));
      const auto complaint = pass(watch, time);
      if (complaint && !stop.stop_requested()) lost(*complaint);
    }
  }

  [[nodiscard]] std::optional<std::string> pass(RankWatch& watch, Clock::duration time) {
    watch.hear(rank, progress);
    int flag = 0;
    MPI_Message message = MPI_MESSAGE_NULL;
    MPI_Status status;
    while (MPI_Improbe(MPI_ANY_SOURCE, 0, beats, &flag, &message, &status), flag != 0) {
      std::uint64_t its = 0;
      MPI_Mrecv(&its, 1, MPI_UINT64_T, &message, MPI_STATUS_IGNORE);
      watch.hear(status.MPI_SOURCE, its);
    }
    return watch.pass(time);
  }

  void look_at_own_work(double time) {
    const std::uint64_t messages_now = activity.messages;
    const double work_now = work_of_others() - 1e-9 * static_cast<double>(activity.idle);
    const bool works = activity.waiting == 0 && work_now - work > kLeastWork * time;
    if (messages_now != messages || works) ++progress;
    messages = messages_now;
    work = work_now;
  }

  void tell() {
    const int end = rank == 0 ? size : 1;
    for (int to = 0; to < end; ++to) {
      if (to == rank) continue;
      Sent& beat = sent[to];
      int is_gone = 1;
      if (beat.request != MPI_REQUEST_NULL) MPI_Test(&beat.request, &is_gone, MPI_STATUS_IGNORE);
      if (is_gone == 0) continue;  // whoever does not take one needs no second
      beat.progress = progress;
      MPI_Isend(&beat.progress, 1, MPI_UINT64_T, to, 0, beats, &beat.request);
    }
  }
};

Heartbeat::Heartbeat(const RankActivity& activity, Seconds patience,
                     std::function<void(const std::string&)> lost)
    : implementation_(std::make_unique<Implementation>(activity, patience, std::move(lost))) {}

Heartbeat::~Heartbeat() {
  implementation_->thread = {};
  for (Sent& beat : implementation_->sent) {
    if (beat.request != MPI_REQUEST_NULL) MPI_Request_free(&beat.request);
  }
}

void Heartbeat::set_patience(Seconds patience) { implementation_->patience = patience.count(); }

}  // namespace apps
