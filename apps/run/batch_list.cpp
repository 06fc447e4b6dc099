#include "apps/run/batch_list.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <map>
#include <string_view>
#include <utility>

#include "io/base/json_item.h"

namespace apps {
namespace {

using io::JsonItem;
namespace fs = std::filesystem;

constexpr auto kListKeys =
    std::to_array<std::string_view>({"description", "command", "options", "output", "entries"});
constexpr auto kEntryKeys =
    std::to_array<std::string_view>({"name", "scene", "command", "options", "output"});
constexpr auto kBatchCommands =
    std::to_array<std::string_view>({"solve", "render", "form-factors", "exchange", "comfort",
                                     "daylight", "daylight-year", "inspect"});
/// What the batch gives itself, or entries have keys for.
constexpr auto kOwnOptions =
    std::to_array<std::string_view>({"json", "quiet", "output", "help", "version"});
constexpr std::string_view kNameMark = "{name}";

/// The words of each option, by its name.
using Options = std::map<std::string, std::vector<std::string>>;

/// What entries have if they say nothing else.
struct Common {
  std::string command = "solve";
  Options options;
  std::vector<std::string> outputs;
};

std::string read_command(const JsonItem& item) {
  const std::string command = item.text();
  if (std::find(kBatchCommands.begin(), kBatchCommands.end(), command) == kBatchCommands.end()) {
    item.fail(
        fmt::format("found '{}', expected one of {}", command, fmt::join(kBatchCommands, ", ")));
  }
  return command;
}

std::string option_word(const JsonItem& item, const std::string& name) {
  const io::Json& value = item.value();
  if (value.is_string()) return fmt::format("--{}={}", name, item.text());
  if (value.is_number()) return fmt::format("--{}={}", name, value.dump());
  item.fail("expected true, false, a number, a text or a list of these");
}

Options read_options(const JsonItem& item, Options options) {
  if (!item.value().is_object()) item.fail("expected an object of options and values");
  for (const auto& [name, value] : item.value().items()) {
    const JsonItem option = item.at(name);
    const bool is_name = !name.empty() && name.front() != '-' &&
                         std::all_of(name.begin(), name.end(),
                                     [](char c) { return c == '-' || (c >= 'a' && c <= 'z'); });
    if (!is_name) option.fail("expected the name of an option, without dashes in front");
    if (std::find(kOwnOptions.begin(), kOwnOptions.end(), name) != kOwnOptions.end()) {
      option.fail("is not an option for a batch");
    }
    std::vector<std::string>& words = options[name];
    words.clear();
    if (value.is_boolean()) {
      if (option.boolean()) words.push_back("--" + name);
    } else if (value.is_array()) {
      for (std::size_t k = 0; k < option.size(); ++k) {
        words.push_back(option_word(option[k], name));
      }
    } else {
      words.push_back(option_word(option, name));
    }
  }
  return options;
}

std::vector<std::string> read_outputs(const JsonItem& item) {
  if (item.value().is_string()) return {item.text()};
  std::vector<std::string> outputs;
  for (std::size_t k = 0; k < item.size(); ++k) outputs.push_back(item[k].text());
  return outputs;
}

Common read_common(const JsonItem& item, Common common) {
  if (const auto command = item.find("command")) common.command = read_command(*command);
  if (const auto options = item.find("options")) {
    common.options = read_options(*options, std::move(common.options));
  }
  if (const auto output = item.find("output")) common.outputs = read_outputs(*output);
  return common;
}

/// Whether a name is what a pattern says, in which `*` stands for anything.
bool fits(std::string_view name, std::string_view pattern) {
  if (pattern.empty()) return name.empty();
  if (pattern.front() != '*') {
    return !name.empty() && name.front() == pattern.front() &&
           fits(name.substr(1), pattern.substr(1));
  }
  for (std::size_t k = 0; k <= name.size(); ++k) {
    if (fits(name.substr(k), pattern.substr(1))) return true;
  }
  return false;
}

/// The scenes that a text names, from the list's folder.
std::vector<std::string> find_scenes(const JsonItem& item, const fs::path& folder) {
  const std::string text = item.text();
  if (text.find('*') == std::string::npos) return {text};
  const fs::path pattern(text);
  std::vector<std::string> scenes;
  std::error_code error;
  for (const auto& file : fs::directory_iterator(folder / pattern.parent_path(), error)) {
    const std::string name = file.path().filename().string();
    if (!file.is_regular_file(error) || name.front() == '.' ||
        !fits(name, pattern.filename().string())) {
      continue;
    }
    scenes.push_back((pattern.parent_path() / name).string());
  }
  if (scenes.empty()) item.fail(fmt::format("no file fits '{}'", text));
  std::sort(scenes.begin(), scenes.end());
  return scenes;
}

std::string with_name(std::string text, const std::string& name) {
  for (std::size_t at = text.find(kNameMark); at != std::string::npos;
       at = text.find(kNameMark, at + name.size())) {
    text.replace(at, kNameMark.size(), name);
  }
  return text;
}

void add_entries(const JsonItem& item, const Common& of_all, const fs::path& folder,
                 std::vector<BatchEntry>& entries) {
  item.check_keys(kEntryKeys);
  const Common common = read_common(item, of_all);
  for (const std::string& scene : find_scenes(item.at("scene"), folder)) {
    BatchEntry entry{.name = fs::path(scene).stem().string(),
                     .command = common.command,
                     .scene = scene,
                     .outputs = {},
                     .options = {}};
    if (const auto name = item.find("name")) {
      entry.name = with_name(name->text(), entry.name);
      if (entry.name.find('/') != std::string::npos) {
        name->fail("found a '/', which names of files may not have");
      }
    }
    for (const std::string& output : common.outputs) {
      entry.outputs.push_back(with_name(output, entry.name));
    }
    for (const auto& [name, words] : common.options) {
      for (const std::string& word : words) entry.options.push_back(with_name(word, entry.name));
    }
    entries.push_back(std::move(entry));
  }
}

/// Refuses what would be written twice, or over what is read.
void check_files(const JsonItem& list, const std::vector<BatchEntry>& entries,
                 const fs::path& folder) {
  std::map<fs::path, std::string> readers;
  const auto place = [&](const std::string& file) { return fs::weakly_canonical(folder / file); };
  for (const BatchEntry& entry : entries) readers.emplace(place(entry.scene), entry.name);
  std::map<fs::path, std::string> writers;
  for (const BatchEntry& entry : entries) {
    for (const std::string& output : entry.outputs) {
      const auto [other, is_new] = writers.emplace(place(output), entry.name);
      if (!is_new) {
        list.fail(
            fmt::format("'{}' and '{}' write the same file {}", other->second, entry.name, output));
      }
      const auto reader = readers.find(place(output));
      if (reader != readers.end()) {
        list.fail(fmt::format("'{}' writes {}, which is the scene of '{}'", entry.name, output,
                              reader->second));
      }
    }
  }
}

}  // namespace

std::vector<std::string> command_line(const BatchEntry& entry) {
  std::vector<std::string> words{entry.command};
  words.insert(words.end(), entry.options.begin(), entry.options.end());
  for (const std::string& output : entry.outputs) words.push_back("--output=" + output);
  words.push_back(entry.scene.starts_with('-') ? "./" + entry.scene : entry.scene);
  return words;
}

fs::path batch_folder(const fs::path& list) {
  return list.parent_path().empty() ? fs::path(".") : list.parent_path();
}

std::vector<BatchEntry> read_batch_list(const fs::path& path) {
  const io::Json json = io::parse_json(path);
  const JsonItem file(json, path);
  file.check_keys(kListKeys);
  const Common common = read_common(file, {});
  const JsonItem list = file.at("entries");
  std::vector<BatchEntry> entries;
  for (std::size_t k = 0; k < list.size(); ++k) {
    add_entries(list[k], common, batch_folder(path), entries);
  }
  if (entries.empty()) list.fail("has no entries");
  check_files(list, entries, batch_folder(path));
  return entries;
}

}  // namespace apps
