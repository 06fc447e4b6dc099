#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace apps {

/// A run of the program that a batch asks for.
struct BatchEntry {
  std::string name;                  ///< of its own, or that of its scene's file
  std::string command;               ///< "solve", "form-factors" or another of a scene
  std::string scene;                 ///< file, from the list's folder
  std::vector<std::string> outputs;  ///< likewise; what stands for {name} is put in
  std::vector<std::string> options;  ///< words of the command line, "--patches=500"
};

/// All words of the command line of an entry, but for the program.
std::vector<std::string> command_line(const BatchEntry& entry);

/// Reads a list of runs (docs/command-line.md): common command, options and outputs, and entries
/// that have or replace them. A `*` in the name of a scene's file makes an entry of each file that
/// fits, in alphabetical order. Throws SceneError naming file and item; also if no file fits, and
/// if two entries write the same file or one writes what another reads.
std::vector<BatchEntry> read_batch_list(const std::filesystem::path& path);

/// The folder that a list's names start from, never empty.
std::filesystem::path batch_folder(const std::filesystem::path& list);

}  // namespace apps
