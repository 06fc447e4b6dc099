#include "radiosity/base/work_stamp.h"

#include <algorithm>
#include <span>
#include <string_view>

#include "radiosity/base/error.h"

namespace radiosity {
namespace {

/// Of all kinds of work files, without the version.
constexpr std::string_view kKinds[] = {"RADTILE", "RADBLCK"};

WorkFileState state_of(const WorkFile& file, const WorkStamp& stamp,
                       const std::filesystem::path& path) {
  const auto n = std::min<std::uint64_t>(file.size(), sizeof(stamp));
  WorkStamp found = stamp;
  const bool is_read = file.read(0, std::as_writable_bytes(std::span(&found, 1)).first(n));
  const std::string_view kind(found.kind.data(), found.kind.size() - 1);
  const bool is_same_version = found.kind.back() == stamp.kind.back();
  if (!is_read || !is_same_version ||
      std::find(std::begin(kKinds), std::end(kKinds), kind) == std::end(kKinds)) {
    throw OutputError(path.string() + ": is not a work file of this version; remove or rename it");
  }
  // The program may have been stopped within the stamp, before any work was done.
  if (n < sizeof(stamp)) return WorkFileState::absent;
  const bool is_same = found.kind == stamp.kind && found.fingerprint == stamp.fingerprint;
  return is_same ? WorkFileState::same : WorkFileState::other;
}

}  // namespace

WorkFileState work_file_state(const std::filesystem::path& path, const WorkStamp& stamp) {
  if (!std::filesystem::exists(path)) return WorkFileState::absent;
  return state_of(WorkFile(path), stamp, path);
}

void begin_work(WorkFile& file, const std::filesystem::path& path, const WorkStamp& stamp,
                WorkStart start) {
  if (start == WorkStart::resumed && state_of(file, stamp, path) == WorkFileState::same) return;
  file.truncate(0);
  file.append(std::as_bytes(std::span(&stamp, 1)));
}

}  // namespace radiosity
