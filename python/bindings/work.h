#pragma once

#include <pybind11/pybind11.h>

#include <cstddef>
#include <functional>

#include "study/study_events.h"

namespace python {

/// What Python code may ask of all long work.
struct WorkOptions {
  pybind11::object report = pybind11::none();  ///< called with (stage, done, total, unit), or None
  std::size_t n_threads = 0;                   ///< 0 = all cores
};

/// Runs long work on a thread of its own and without the interpreter's lock, so that other threads
/// of Python run meanwhile. The calling thread looks for signals (Ctrl-C) and hands on what the
/// work reports, some twenty times a second; warnings follow at the end. Throws what the work
/// throws, or what Python code raised, once the work has ended; radiosity::SolveError in a process
/// that was forked from one that has worked.
void run_work(const WorkOptions& options,
              const std::function<void(const study::StudyEvents&)>& work);

/// Throws radiosity::SolveError as run_work() does.
void refuse_after_fork();

/// What short work gives, done on the calling thread without the interpreter's lock.
template <typename Work>
auto unlocked(const Work& work) {
  refuse_after_fork();
  const pybind11::gil_scoped_release others;
  return work();
}

}  // namespace python
