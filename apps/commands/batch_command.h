#pragma once

#include <string>
#include <vector>

#include "apps/options/common_options.h"
#include "apps/run/batch_run.h"
#include "apps/terminal/interruption.h"

namespace CLI {
class App;
}  // namespace CLI

namespace apps {

/// `radiosity batch LIST.json`: runs the entries of a list, some at a time, and makes one table of
/// what became of them. Adds itself to the program and runs when that is parsed; must outlive the
/// parsing.
class BatchCommand {
 public:
  BatchCommand(CLI::App& program, Interruption& interruption);
  BatchCommand(const BatchCommand&) = delete;
  BatchCommand& operator=(const BatchCommand&) = delete;

 private:
  void run() const;
  /// Throws OutputError if a table cannot be written, or is a file of the list.
  void check_tables(const std::vector<BatchEntry>& entries) const;

  Interruption& interruption_;
  CommonOptions common_;
  std::string list_;
  std::string memory_;
  BatchOptions batch_;
};

}  // namespace apps
