#include "radiosity/base/parallel.h"

#include <sys/resource.h>
#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_group.h>
#include <tbb/task_scheduler_observer.h>
#include <unistd.h>

namespace radiosity {
namespace {

void lower_this_thread() {
  constexpr int kLowest = 19;
  // On Linux, a thread's number stands for that thread alone. Failing only costs smoothness.
  setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), kLowest);
}

}  // namespace

struct ThreadLimit::Implementation {
  explicit Implementation(std::size_t n_threads)
      : control(kThreads, n_threads > 0 ? n_threads : tbb::global_control::active_value(kThreads)) {
  }

  static constexpr auto kThreads = tbb::global_control::max_allowed_parallelism;
  tbb::global_control control;
};

ThreadLimit::ThreadLimit(std::size_t n_threads)
    : implementation_(std::make_unique<Implementation>(n_threads)) {}

ThreadLimit::~ThreadLimit() = default;

struct LowPriority::Implementation : private tbb::task_scheduler_observer {
  Implementation() {
    lower_this_thread();
    observe(true);
  }
  ~Implementation() override { observe(false); }
  Implementation(const Implementation&) = delete;
  Implementation& operator=(const Implementation&) = delete;

  void on_scheduler_entry(bool /*is_worker*/) override { lower_this_thread(); }
};

LowPriority::LowPriority() : implementation_(std::make_unique<Implementation>()) {}
LowPriority::~LowPriority() = default;

void parallel_ranges(std::ptrdiff_t n, std::ptrdiff_t grain,
                     const std::function<void(std::ptrdiff_t, std::ptrdiff_t)>& body) {
  // Otherwise an exception in a loop around this one would end it half-done, and it would return.
  // And numbers next to 0 would vanish or not by who was the first to use TBB: ray tracers let
  // them.
  tbb::task_group_context context(tbb::task_group_context::isolated,
                                  tbb::task_group_context::fp_settings);
  tbb::parallel_for(
      tbb::blocked_range<std::ptrdiff_t>(0, n, grain),
      [&](const tbb::blocked_range<std::ptrdiff_t>& range) { body(range.begin(), range.end()); },
      context);
}

}  // namespace radiosity
