#pragma once

#include <sys/types.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/support/output_folder.h"

namespace radiosity::test {

namespace fs = std::filesystem;
using Arguments = std::vector<std::string>;

/// What a finished run left behind.
struct Outcome {
  int exit_code = -1;  ///< -signal if a signal ended it
  std::string out;
  std::string err;
};

/// What a file holds; "" if there is none.
std::string contents(const fs::path& path);

/// The program, running with its output going to files in `folder`.
class Running {
 public:
  Running(const Arguments& arguments, fs::path folder);

  [[nodiscard]] pid_t pid() const { return pid_; }
  void send(int signal) const;
  /// Waits until the program has printed `words`; whether it has within a minute. What it prints
  /// tells that it listens to signals.
  bool has_told(const std::string& words) const;
  Outcome wait() const;

 private:
  fs::path folder_;
  pid_t pid_ = 0;
};

/// Results go to a folder of their own, beside the scenes and what the program prints.
class Program : public OutputFolder {
 protected:
  Program();

  Running start(const Arguments& arguments) const { return {arguments, folder() / "printed"}; }
  Outcome run(const Arguments& arguments) const { return start(arguments).wait(); }
  /// What a run without an error tells with --json; null if there is one, which fails the test.
  nlohmann::json json_of(Arguments arguments) const;
  /// The same of `solve`.
  nlohmann::json solve(Arguments arguments) const;

  /// File names that the program left in the results folder.
  std::vector<std::string> results() const;
  std::string result(const std::string& name) const;

  std::string write_file(const std::string& name, const std::string& text) const;

  /// The unit cube seen from inside, every wall with the same reflectance and radiance.
  std::string write_cube(double reflectance, double radiance) const;
};

std::string without_warnings(const std::string& text);

/// The one line of an error, as every failure must leave it.
void expect_error(const Outcome& outcome, int exit_code, const std::string& words);

}  // namespace radiosity::test
