#pragma once

#include <array>
#include <cstdint>
#include <filesystem>

#include "radiosity/base/work_file.h"

namespace radiosity {

/// What there is where a work file shall be.
enum class WorkFileState {
  absent,  ///< nothing
  same,    ///< a work file of the same computation
  other    ///< a work file of another one
};

enum class WorkStart { anew, resumed };

/// What a work file starts with: the kind of its records, "RAD" and five more of which the last is
/// the version, and the fingerprint of the computation.
struct WorkStamp {
  std::array<char, 8> kind = {};
  std::uint64_t fingerprint = 0;
};

/// Throws OutputError if there is a file that is no work file of this program's version.
WorkFileState work_file_state(const std::filesystem::path& path, const WorkStamp& stamp);

/// Begins a work file, of which nothing is kept but what a resumed computation has left. Records
/// start after the stamp. Throws OutputError.
void begin_work(WorkFile& file, const std::filesystem::path& path, const WorkStamp& stamp,
                WorkStart start);

}  // namespace radiosity
