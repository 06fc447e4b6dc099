#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/options/common_options.h"
#include "apps/options/daylight_place.h"
#include "apps/options/quantity_options.h"
#include "apps/terminal/interruption.h"
#include "study/daylight_year.h"

namespace CLI {
class App;
}  // namespace CLI

namespace apps {

/// `radiosity daylight-year SCENE --weather FILE`: what points get in the hours of a year. Adds
/// itself to the program and runs when that is parsed; must outlive the parsing.
class DaylightYearCommand {
 public:
  DaylightYearCommand(CLI::App& program, Interruption& interruption);
  DaylightYearCommand(const DaylightYearCommand&) = delete;
  DaylightYearCommand& operator=(const DaylightYearCommand&) = delete;

 private:
  void run() const;

  Interruption& interruption_;
  CommonOptions common_;
  study::StudyOptions compute_;
  study::YearOptions year_;
  std::string weather_;  // file
  DaylightPlace place_;
  std::optional<std::vector<double>> north_;
  double threshold_ = 300;  // lx
  int from_ = 8;            // o'clock
  int to_ = 18;             // o'clock
};

}  // namespace apps
