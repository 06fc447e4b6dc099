#include "python/bindings/work.h"

#include <unistd.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "radiosity/base/error.h"
#include "radiosity/base/parallel.h"

namespace python {
namespace {

namespace py = pybind11;
using radiosity::Progress;

constexpr std::chrono::milliseconds kGlance(50);

/// Work on a thread of its own, and what it tells.
class Job {
 public:
  Job(std::size_t n_threads, const std::function<void(const study::StudyEvents&)>& work)
      : thread_([this, n_threads, &work] {
          try {
            const radiosity::ThreadLimit limit(n_threads);
            work(events());
          } catch (...) {
            error_ = std::current_exception();
          }
          const std::lock_guard lock(mutex_);
          is_done_ = true;
          changed_.notify_all();
        }) {}

  struct Report {
    std::string stage;
    double done = 0;
    double total = 0;
    std::string unit;
  };

  /// Waits for the end, but not long. What was reported since, if anything.
  std::optional<Report> glance() {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, kGlance, [this] { return is_done_; });
    return std::exchange(latest_, std::nullopt);
  }
  [[nodiscard]] bool is_done() {
    const std::lock_guard lock(mutex_);
    return is_done_;
  }
  void stop() { stop_.request_stop(); }
  /// Waits for the end. Throws what the work threw.
  void finish() {
    thread_.join();
    if (error_) std::rethrow_exception(error_);
  }
  /// Waits for the end, whatever it is.
  void abandon() {
    stop();
    thread_.join();
  }
  /// After the end.
  [[nodiscard]] const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  study::StudyEvents events() {
    return {.warned =
                [this](const std::string& message) {
                  const std::lock_guard lock(mutex_);
                  warnings_.push_back(message);
                },
            .progress = {.report =
                             [this](std::string_view stage, double done, double total,
                                    std::string_view unit) {
                               const std::lock_guard lock(mutex_);
                               latest_ = Report{std::string(stage), done, total, std::string(unit)};
                             },
                         .stop = stop_.get_token()}};
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  bool is_done_ = false;
  std::optional<Report> latest_;
  std::vector<std::string> warnings_;
  std::exception_ptr error_;
  std::stop_source stop_;
  std::thread thread_;  // the last: it uses the others
};

/// Looks after a job until it is done. Throws what Python code raises.
void look_after(Job& job, const py::object& report) {
  bool is_done = false;
  while (!is_done) {
    std::optional<Job::Report> latest;
    {
      const py::gil_scoped_release others;
      latest = job.glance();
      is_done = job.is_done();
    }
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    if (latest && !report.is_none()) {
      report(latest->stage, latest->done, latest->total, latest->unit);
    }
  }
}

}  // namespace

void refuse_after_fork() {
  // Threads do not live on in a forked process, where those that wait for them do so for ever.
  static std::atomic<pid_t> worker{0};
  pid_t none = 0;
  worker.compare_exchange_strong(none, getpid());
  if (worker == getpid()) return;
  throw radiosity::SolveError(
      "this process was forked from one that has used radiosity, whose threads it lacks: use "
      "multiprocessing.get_context(\"spawn\")");
}

void run_work(const WorkOptions& options,
              const std::function<void(const study::StudyEvents&)>& work) {
  refuse_after_fork();
  Job job(options.n_threads, work);
  try {
    look_after(job, options.report);
  } catch (...) {
    const py::gil_scoped_release others;
    job.abandon();
    throw;
  }
  {
    const py::gil_scoped_release others;
    job.finish();
  }
  const py::object warn = py::module_::import("radiosity._errors").attr("warn");
  for (const std::string& message : job.warnings()) warn(message);
}

}  // namespace python
