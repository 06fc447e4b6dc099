#include "apps/run/batch_journal.h"

#include <fmt/format.h>

#include <fstream>
#include <set>
#include <span>
#include <sstream>
#include <utility>

#include "io/base/json_item.h"
#include "io/scene/scene_file.h"
#include "radiosity/base/error.h"
#include "radiosity/base/fingerprint.h"
#include "radiosity/version.h"

namespace apps {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kFirstLine = "radiosity batch journal 1\n";
constexpr std::size_t kPiece = 1 << 20;

/// The files that a run reads: those of the scene, and what is one among its options' values.
std::set<fs::path> input_files(const BatchEntry& entry, const fs::path& folder,
                               const radiosity::Progress& progress) {
  std::set<fs::path> files;
  for (const fs::path& file : io::read_scene(folder / entry.scene, {.progress = progress}).files) {
    files.insert(file);
  }
  for (const std::string& word : entry.options) {
    const std::size_t equals = word.find('=');
    if (equals == std::string::npos) continue;
    const fs::path file = folder / word.substr(equals + 1);
    std::error_code error;
    if (fs::is_regular_file(file, error)) files.insert(file);
  }
  return files;
}

void add_file(radiosity::Fingerprint& stamp, const fs::path& path,
              const radiosity::Progress& progress) {
  std::ifstream file(path, std::ios::binary);
  std::vector<char> piece(kPiece);
  while (file) {
    progress.check();
    file.read(piece.data(), kPiece);
    stamp.add(std::as_bytes(std::span(piece).first(static_cast<std::size_t>(file.gcount()))));
  }
}

std::string read_all(const radiosity::WorkFile& file) {
  std::string text(file.size(), '\0');
  if (!file.read(0, std::as_writable_bytes(std::span(text)))) text.clear();
  return text;
}

void append(radiosity::WorkFile& file, std::string_view text) {
  file.append(std::as_bytes(std::span(text)));
}

}  // namespace

std::optional<std::string> input_stamp(const BatchEntry& entry, const fs::path& folder,
                                       const radiosity::Progress& progress) {
  try {
    radiosity::Fingerprint stamp;
    stamp.add(std::string(radiosity::kVersion));
    stamp.add(std::string(radiosity::kCommit));
    for (const std::string& word : command_line(entry)) stamp.add(word);
    for (const fs::path& file : input_files(entry, folder, progress)) {
      stamp.add(file.string());
      add_file(stamp, file, progress);
    }
    return stamp.text();
  } catch (const radiosity::Interrupted&) {
    throw;
  } catch (const std::exception&) {
    return std::nullopt;
  }
}

BatchJournal::BatchJournal(const fs::path& path) : file_(path) {
  const std::string text = read_all(file_);
  if (text.empty()) {
    append(file_, kFirstLine);
    return;
  }
  if (!text.starts_with(kFirstLine)) {
    throw radiosity::OutputError(
        fmt::format("{}: is no journal of a batch; remove or rename it", path.string()));
  }
  std::size_t begin = kFirstLine.size();
  for (std::size_t end = 0; (end = text.find('\n', begin)) != std::string::npos; begin = end + 1) {
    const io::Json line = io::Json::parse(text.substr(begin, end - begin), nullptr, false);
    if (!line.is_object() || !line.contains("stamp") || !line["stamp"].is_string()) continue;
    BatchRecord record;
    record.seconds = line.value("seconds", 0.0);
    record.peak_memory = line.value("memory", std::uint64_t{0});
    record.summary = line.value("summary", "");
    records_[line["stamp"].get<std::string>()] = record;
  }
  if (begin < text.size()) file_.truncate(begin);
}

std::optional<BatchRecord> BatchJournal::find(const std::string& stamp) const {
  const auto found = records_.find(stamp);
  return found == records_.end() ? std::nullopt : std::optional(found->second);
}

void BatchJournal::add(const std::string& stamp, const BatchRecord& record) {
  const io::Json line = {{"stamp", stamp},
                         {"seconds", record.seconds},
                         {"memory", record.peak_memory},
                         {"summary", record.summary}};
  append(file_, line.dump(-1, ' ', true, io::Json::error_handler_t::replace) + "\n");
  records_[stamp] = record;
}

}  // namespace apps
