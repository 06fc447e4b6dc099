#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "apps/options/common_options.h"
#include "apps/terminal/interruption.h"
#include "apps/validation/report/report.h"

namespace CLI {
class App;
}  // namespace CLI

namespace apps {

/// `radiosity validate [CASE...] -o DIR`: compares the program with known answers and writes a
/// report. Adds itself to the program and runs when that is parsed; must outlive the parsing.
class ValidateCommand {
 public:
  ValidateCommand(CLI::App& program, Interruption& interruption);
  ValidateCommand(const ValidateCommand&) = delete;
  ValidateCommand& operator=(const ValidateCommand&) = delete;

 private:
  void run() const;
  [[nodiscard]] std::vector<validation::Case> chosen_cases() const;
  [[nodiscard]] validation::Report run_cases() const;
  void write_report(const validation::Report& report) const;

  Interruption& interruption_;
  std::vector<std::string> cases_;
  std::string folder_;
  std::string data_;
  std::string scenes_;
  CommonOptions common_;
  std::uint64_t seed_ = 0;
  bool list_ = false;
};

}  // namespace apps
