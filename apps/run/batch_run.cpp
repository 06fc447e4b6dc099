#include "apps/run/batch_run.h"

#include <fmt/format.h>
#include <stdlib.h>
#include <string.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <iterator>
#include <memory>
#include <optional>
#include <string_view>
#include <thread>
#include <utility>

#include "apps/terminal/child_process.h"
#include "io/base/json_item.h"
#include "radiosity/base/error.h"
#include "radiosity/base/machine_memory.h"

namespace apps {
namespace {

namespace fs = std::filesystem;

constexpr auto kLook = std::chrono::milliseconds(5);
/// A run that was asked to stop ends by itself within a second.
constexpr auto kPatience = std::chrono::seconds(5);
constexpr std::string_view kErrorMark = "radiosity: error: ";

/// A folder of its own for what runs print, removed at the end.
class PrintFolder {
 public:
  PrintFolder()
      : path_(fs::absolute(fs::temp_directory_path() / "radiosity-batch-XXXXXX").string()) {
    if (::mkdtemp(path_.data()) == nullptr) {
      throw radiosity::OutputError(fmt::format("{}: cannot be made", path_));
    }
  }
  ~PrintFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  PrintFolder(const PrintFolder&) = delete;
  PrintFolder& operator=(const PrintFolder&) = delete;

  [[nodiscard]] fs::path file(std::size_t entry, std::string_view stream) const {
    return fs::path(path_) / fmt::format("{}.{}", entry, stream);
  }

 private:
  std::string path_;
};

std::string content(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// The program's error among what it printed on stderr.
std::string error_line(const std::string& printed) {
  const std::size_t mark = printed.rfind(kErrorMark);
  if (mark == std::string::npos) return "";
  const std::size_t begin = mark + kErrorMark.size();
  return printed.substr(begin, printed.find('\n', begin) - begin);
}

std::string ending(int exit_code, const std::string& printed) {
  if (const std::string line = error_line(printed); !line.empty()) return line;
  if (exit_code >= 0) return fmt::format("ended with exit code {}", exit_code);
  return fmt::format("was ended by signal {}{}", -exit_code,
                     exit_code == -9 ? ", perhaps for lack of memory" : "");
}

bool has_option(const BatchEntry& entry, const std::string& name) {
  return std::any_of(entry.options.begin(), entry.options.end(), [&](const std::string& word) {
    return word == "--" + name || word.starts_with("--" + name + "=");
  });
}

/// Whether all files are there that a run says it has written.
bool has_outputs(const BatchRecord& record, const fs::path& folder) {
  const io::Json summary = io::Json::parse(record.summary, nullptr, false);
  if (!summary.is_object() || !summary.contains("outputs")) return true;
  return std::all_of(
      summary["outputs"].begin(), summary["outputs"].end(), [&](const io::Json& output) {
        std::error_code error;
        return output.is_string() && fs::exists(folder / output.get<std::string>(), error);
      });
}

/// The entries at work.
class BatchRunner {
 public:
  BatchRunner(std::vector<BatchResult>& results, const fs::path& folder, BatchJournal& journal,
              const BatchOptions& options, const radiosity::Progress& progress)
      : results_(results),
        folder_(folder),
        journal_(journal),
        options_(options),
        progress_(progress) {}

  void run() {
    for (std::size_t k = 0; k < results_.size() && !is_stopping(); ++k) {
      while (running_.size() >= options_.n_jobs && !is_stopping()) wait();
      if (!is_stopping()) begin(k);
    }
    while (!running_.empty() && !is_stopping()) wait();
    if (!running_.empty()) stop();
  }

 private:
  struct Run {
    std::size_t number;
    std::optional<std::string> stamp;
    std::unique_ptr<ChildProcess> process;
  };

  [[nodiscard]] bool is_stopping() const { return progress_.stop.stop_requested(); }

  /// Starts an entry, unless it was done before.
  void begin(std::size_t number) {
    BatchResult& result = results_[number];
    std::optional<std::string> stamp;
    try {
      stamp = input_stamp(result.entry, folder_, {.report = {}, .stop = progress_.stop});
    } catch (const radiosity::Interrupted&) {
      return;
    }
    if (stamp && !options_.again) {
      const std::optional<BatchRecord> record = journal_.find(*stamp);
      if (record && has_outputs(*record, folder_)) {
        result.status = BatchStatus::kept;
        result.record = *record;
        return tell();
      }
    }
    running_.push_back(
        {number, stamp,
         std::make_unique<ChildProcess>(words(result.entry), folder_, print_.file(number, "out"),
                                        print_.file(number, "err"))});
  }

  /// Its command line, with its share of the machine.
  [[nodiscard]] std::vector<std::string> words(const BatchEntry& entry) const {
    std::vector<std::string> result = command_line(entry);
    const auto add = [&](const std::string& word) { result.insert(result.end() - 1, word); };
    add("--json");
    add("--quiet");
    const std::size_t n_jobs = std::min(options_.n_jobs, results_.size());
    if (!has_option(entry, "threads")) {
      const std::size_t n =
          options_.n_threads > 0 ? options_.n_threads : std::thread::hardware_concurrency();
      add(fmt::format("--threads={}", std::max<std::size_t>(n / n_jobs, 1)));
    }
    const std::size_t memory =
        options_.memory > 0 ? options_.memory : radiosity::usable_memory() / 2;
    if (memory > 0 && entry.command != "inspect" && !has_option(entry, "memory")) {
      add(fmt::format("--memory={}", memory / n_jobs));
    }
    return result;
  }

  /// Waits a little, and takes what has ended.
  void wait() {
    bool any = false;
    for (std::size_t k = 0; k < running_.size();) {
      const std::optional<ProcessEnd> end = running_[k].process->poll();
      if (end) {
        finish(running_[k], *end);
        running_.erase(running_.begin() + static_cast<std::ptrdiff_t>(k));
        any = true;
      } else {
        ++k;
      }
    }
    if (!any) std::this_thread::sleep_for(kLook);
  }

  void finish(const Run& run, const ProcessEnd& end) {
    BatchResult& result = results_[run.number];
    result.exit_code = end.exit_code;
    result.record = {end.seconds, end.peak_memory, ""};
    if (end.exit_code == 0) {
      result.status = BatchStatus::done;
      result.record.summary = content(print_.file(run.number, "out"));
      if (run.stamp) journal_.add(*run.stamp, result.record);
    } else if (is_stopping()) {
      result.status = BatchStatus::stopped;
    } else {
      result.status = BatchStatus::failed;
      result.message = ending(end.exit_code, content(print_.file(run.number, "err")));
    }
    for (const char* stream : {"out", "err"}) fs::remove(print_.file(run.number, stream));
    tell();
  }

  void stop() {
    for (const Run& run : running_) run.process->stop();
    const auto limit = std::chrono::steady_clock::now() + kPatience;
    while (!running_.empty()) {
      wait();
      if (std::chrono::steady_clock::now() < limit) continue;
      for (const Run& run : running_) run.process->kill();
    }
  }

  void tell() {
    ++n_ended_;
    if (!progress_.report) return;
    progress_.report("batch", static_cast<double>(n_ended_), static_cast<double>(results_.size()),
                     "entries");
  }

  std::vector<BatchResult>& results_;
  const fs::path& folder_;
  BatchJournal& journal_;
  const BatchOptions& options_;
  const radiosity::Progress& progress_;
  PrintFolder print_;
  std::vector<Run> running_;
  std::size_t n_ended_ = 0;
};

}  // namespace

std::string_view status_name(BatchStatus status) {
  switch (status) {
    case BatchStatus::waiting:
      return "waiting";
    case BatchStatus::done:
      return "done";
    case BatchStatus::kept:
      return "kept";
    case BatchStatus::failed:
      return "failed";
    case BatchStatus::stopped:
      return "stopped";
  }
  return "";
}

std::vector<BatchResult> run_batch(const std::vector<BatchEntry>& entries, const fs::path& folder,
                                   BatchJournal& journal, const BatchOptions& options,
                                   const radiosity::Progress& progress) {
  std::vector<BatchResult> results;
  for (const BatchEntry& entry : entries) results.push_back({.entry = entry});
  BatchRunner(results, folder, journal, options, progress).run();
  return results;
}

}  // namespace apps
