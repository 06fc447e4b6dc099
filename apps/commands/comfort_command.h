#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/options/common_options.h"
#include "apps/terminal/interruption.h"
#include "radiosity/base/progress.h"
#include "study/comfort.h"

namespace CLI {
class App;
}  // namespace CLI

namespace apps {

/// `radiosity comfort SCENE --at x,y,z -o comfort.csv`: solves the scene and tells the mean radiant
/// temperature of a person at points. Adds itself to the program and runs when that is parsed; must
/// outlive the parsing.
class ComfortCommand {
 public:
  ComfortCommand(CLI::App& program, Interruption& interruption);
  ComfortCommand(const ComfortCommand&) = delete;
  ComfortCommand& operator=(const ComfortCommand&) = delete;

 private:
  void run() const;
  [[nodiscard]] std::vector<radiosity::Vec3> points(const radiosity::Progress& progress) const;
  [[nodiscard]] study::ComfortOptions comfort_options() const;

  Interruption& interruption_;
  CommonOptions common_;
  study::StudyOptions compute_;
  std::optional<std::string> operator_;
  std::vector<std::string> at_;
  std::optional<std::string> points_;
  std::string posture_ = "standing";
  std::string body_ = "six-planes";
  std::optional<std::string> facing_;
  std::string up_ = "0,0,1";
};

}  // namespace apps
