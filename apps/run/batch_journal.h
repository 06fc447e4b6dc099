#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "apps/run/batch_list.h"
#include "radiosity/base/progress.h"
#include "radiosity/base/work_file.h"

namespace apps {

/// What a finished run of a batch has left to be told.
struct BatchRecord {
  double seconds = 0;             ///< that it took
  std::uint64_t peak_memory = 0;  ///< bytes
  std::string summary;            ///< what it printed: JSON
};

/// A hash of all that a run's result depends on: the program's version, its options, and every file
/// that its scene or its options name. Nothing if the scene cannot be read: the run will tell why.
/// Throws Interrupted.
std::optional<std::string> input_stamp(const BatchEntry& entry, const std::filesystem::path& folder,
                                       const radiosity::Progress& progress);

/// Remembers in a file what was done, so that it is not done again: a line for each run, appended
/// when it has ended. What a killed program has left half written does not count.
class BatchJournal {
 public:
  /// Opens or makes the file. Throws OutputError if it is no journal, is in use by another run, or
  /// cannot be written.
  explicit BatchJournal(const std::filesystem::path& path);

  /// What there is of inputs of this stamp.
  [[nodiscard]] std::optional<BatchRecord> find(const std::string& stamp) const;
  void add(const std::string& stamp, const BatchRecord& record);

 private:
  radiosity::WorkFile file_;
  std::map<std::string, BatchRecord> records_;
};

}  // namespace apps
