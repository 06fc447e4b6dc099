#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/options/common_options.h"
#include "apps/options/daylight_place.h"
#include "apps/options/quantity_options.h"
#include "apps/terminal/interruption.h"
#include "study/daylight.h"

namespace CLI {
class App;
}  // namespace CLI

namespace apps {

/// `radiosity daylight SCENE`: daylight factors on a work plane or at points. Adds itself to the
/// program and runs when that is parsed; must outlive the parsing.
class DaylightCommand {
 public:
  DaylightCommand(CLI::App& program, Interruption& interruption);
  DaylightCommand(const DaylightCommand&) = delete;
  DaylightCommand& operator=(const DaylightCommand&) = delete;

 private:
  void run() const;
  [[nodiscard]] study::Study make_light(const study::StudyEvents& events) const;
  [[nodiscard]] std::vector<study::DaylightPoint> make_points(
      const study::Study& study, const radiosity::Progress& progress) const;

  Interruption& interruption_;
  CommonOptions common_;
  study::StudyOptions compute_;
  PhotometryOptions photometry_;
  DaylightPlace place_;
  std::vector<std::string> outdoors_;  // names of surfaces
};

}  // namespace apps
