#include "viewer/work/worker.h"

#include <exception>
#include <new>
#include <utility>

#include "radiosity/base/error.h"
#include "radiosity/base/parallel.h"

namespace viewer {

void Pause::set(bool is_on) {
  {
    const std::scoped_lock lock(mutex_);
    is_on_ = is_on;
  }
  changed_.notify_all();
}

bool Pause::is_on() const {
  const std::scoped_lock lock(mutex_);
  return is_on_;
}

void Pause::wait(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, stop, [this] { return !is_on_; });
}

void rest(std::chrono::duration<double> time, const std::stop_token& stop) {
  std::mutex mutex;
  std::condition_variable_any never;
  std::unique_lock lock(mutex);
  never.wait_for(lock, stop, time, [] { return false; });
}

Worker::Worker(Pause* pause) : pause_(pause), thread_([this] { run(); }) {}

Worker::~Worker() {
  cancel();
  {
    const std::scoped_lock lock(mutex_);
    has_ended_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void Worker::start(Task task) {
  {
    const std::scoped_lock lock(mutex_);
    drop_task();
    stop_ = std::stop_source();
    next_ = std::move(task);
    status_ = {.is_busy = true};
  }
  changed_.notify_all();
}

void Worker::cancel() {
  const std::scoped_lock lock(mutex_);
  drop_task();
}

void Worker::drop_task() {
  stop_.request_stop();
  next_.reset();
  // Else the worker would seem busy with what nobody waits for.
  posted_.clear();
  error_.reset();
  status_ = {};
}

WorkStatus Worker::status() const {
  const std::scoped_lock lock(mutex_);
  return status_;
}

bool Worker::is_busy() const {
  const std::scoped_lock lock(mutex_);
  return status_.is_busy || !posted_.empty() || error_;
}

bool Worker::deliver() {
  std::vector<Posted> posted;
  {
    const std::scoped_lock lock(mutex_);
    posted.swap(posted_);
  }
  for (const Posted& item : posted) {
    // An earlier one may have cancelled the task.
    if (!item.stop.stop_requested()) item.deliver();
  }
  return !posted.empty();
}

std::optional<std::string> Worker::take_error() {
  const std::scoped_lock lock(mutex_);
  return std::exchange(error_, std::nullopt);
}

void Worker::post(const std::stop_token& stop, std::function<void()> deliver) {
  const std::scoped_lock lock(mutex_);
  if (!stop.stop_requested()) posted_.push_back({stop, std::move(deliver)});
}

radiosity::Progress Worker::make_progress(const std::stop_token& stop) {
  radiosity::Progress progress;
  progress.stop = stop;
  progress.report = [this, stop](std::string_view stage, double done, double total,
                                 std::string_view unit) {
    if (pause_ != nullptr) pause_->wait(stop);
    const std::scoped_lock lock(mutex_);
    if (stop.stop_requested()) return;
    status_ = {.is_busy = true,
               .stage = std::string(stage),
               .done = done,
               .total = total,
               .unit = std::string(unit)};
  };
  return progress;
}

void Worker::perform(const Task& task, const std::stop_token& stop) {
  std::string error;
  try {
    Context context;
    context.progress = make_progress(stop);
    context.worker_ = this;
    task(context);
  } catch (const radiosity::Interrupted&) {
  } catch (const std::bad_alloc&) {
    error = "out of memory; fewer patches need less";
  } catch (const std::exception& exception) {
    error = exception.what();
  }
  const std::scoped_lock lock(mutex_);
  if (stop.stop_requested()) return;
  status_ = {};
  if (!error.empty()) error_ = error;
}

void Worker::run() {
  const radiosity::LowPriority low_priority;
  while (true) {
    Task task;
    std::stop_token stop;
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [this] { return has_ended_ || next_; });
      if (has_ended_) return;
      task = std::move(*next_);
      next_.reset();
      stop = stop_.get_token();
    }
    perform(task, stop);
  }
}

}  // namespace viewer
