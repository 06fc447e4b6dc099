#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "radiosity/base/progress.h"

namespace viewer {

/// Holds work back while it is on. All methods may be called from any thread.
class Pause {
 public:
  void set(bool is_on);
  [[nodiscard]] bool is_on() const;
  /// Returns once the pause is over or `stop` is requested.
  void wait(const std::stop_token& stop);

 private:
  mutable std::mutex mutex_;
  std::condition_variable_any changed_;
  bool is_on_ = false;
};

/// Sleeps for so long, or until `stop` is requested.
void rest(std::chrono::duration<double> time, const std::stop_token& stop);

/// Where a worker stands.
struct WorkStatus {
  bool is_busy = false;
  std::string stage = {};  ///< "form factors"
  double done = 0;         ///< in `unit`s
  double total = 0;        ///< 0 if it is not known
  std::string unit = {};
};

/// A thread of low priority that works on one task at a time, the latest. What a task finds reaches
/// the window's thread by `post`, and only while the task is wanted.
class Worker {
 public:
  /// What a task may use.
  class Context {
   public:
    radiosity::Progress progress;  ///< stops the task when it is not wanted any more
    /// Has `deliver` called by `Worker::deliver`, unless the task is cancelled before.
    void post(std::function<void()> deliver) const {
      worker_->post(progress.stop, std::move(deliver));
    }

   private:
    friend class Worker;
    Worker* worker_ = nullptr;
  };
  using Task = std::function<void(const Context&)>;

  /// `pause`, if there is one, must outlive the worker.
  explicit Worker(Pause* pause = nullptr);
  ~Worker();
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  /// Cancels what is being done and begins with `task`. An exception that leaves it other than
  /// Interrupted is kept for `take_error`.
  void start(Task task);
  /// Cancels what is being done.
  void cancel();
  [[nodiscard]] WorkStatus status() const;
  /// Whether a task is wanted, or left something that is neither delivered nor taken yet.
  [[nodiscard]] bool is_busy() const;

  /// Calls what tasks have posted, on the calling thread; whether there was something.
  bool deliver();
  /// What made the latest task fail, once.
  std::optional<std::string> take_error();

 private:
  struct Posted {
    std::stop_token stop;
    std::function<void()> deliver;
  };
  void run();
  void drop_task();  // with mutex_ locked
  void post(const std::stop_token& stop, std::function<void()> deliver);
  radiosity::Progress make_progress(const std::stop_token& stop);
  void perform(const Task& task, const std::stop_token& stop);

  Pause* pause_;
  mutable std::mutex mutex_;  // guards what follows
  std::condition_variable changed_;
  std::optional<Task> next_;
  std::stop_source stop_;  // of the task that runs or is next
  WorkStatus status_;
  std::vector<Posted> posted_;
  std::optional<std::string> error_;
  bool has_ended_ = false;
  std::thread thread_;
};

}  // namespace viewer
