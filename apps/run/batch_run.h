#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "apps/run/batch_journal.h"
#include "apps/run/batch_list.h"
#include "radiosity/base/progress.h"

namespace apps {

/// What became of an entry.
enum class BatchStatus {
  waiting,  ///< not begun, since the batch was interrupted
  done,
  kept,    ///< done by an earlier batch
  failed,  ///< `message` tells why
  stopped  ///< interrupted
};

/// "waiting", "done", "kept", "failed" or "stopped".
std::string_view status_name(BatchStatus status);

struct BatchResult {
  BatchEntry entry;
  BatchStatus status = BatchStatus::waiting;
  int exit_code = 0;     ///< -signal if a signal ended it
  BatchRecord record{};  ///< if it was done, now or before; else what it took
  std::string message{};
};

struct BatchOptions {
  std::size_t n_jobs = 1;     ///< entries at a time, > 0
  std::size_t memory = 0;     ///< bytes for all at a time; 0 = half of what there is
  std::size_t n_threads = 0;  ///< for all at a time; 0 = all cores
  bool again = false;         ///< also what was done before
};

/// Runs all entries that were not done before, each as a process of its own, in the list's folder.
/// None stops the others. A requested stop is passed on to those that run and waited for; it is no
/// exception, and the rest is left waiting. Throws OutputError if the journal or the folder for
/// what they print cannot be written.
std::vector<BatchResult> run_batch(const std::vector<BatchEntry>& entries,
                                   const std::filesystem::path& folder, BatchJournal& journal,
                                   const BatchOptions& options,
                                   const radiosity::Progress& progress);

}  // namespace apps
