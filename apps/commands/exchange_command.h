#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "apps/options/common_options.h"
#include "apps/terminal/interruption.h"
#include "io/result/network_file.h"
#include "study/study.h"

namespace CLI {
class App;
}  // namespace CLI

namespace apps {

/// `radiosity exchange SCENE -o gr.csv`: the radiative couplings between surfaces or patches.
/// Adds itself to the program and runs when that is parsed; must outlive the parsing.
class ExchangeCommand {
 public:
  ExchangeCommand(CLI::App& program, Interruption& interruption);
  ExchangeCommand(const ExchangeCommand&) = delete;
  ExchangeCommand& operator=(const ExchangeCommand&) = delete;

 private:
  void run() const;
  [[nodiscard]] io::NamedNetwork make_network(const study::Study& study,
                                              const radiosity::Progress& progress) const;

  Interruption& interruption_;
  CommonOptions common_;
  study::StudyOptions compute_;
  std::optional<std::string> operator_;
  std::string by_ = "surface";
  std::optional<std::string> nodes_;  // file
  std::int64_t space_node_ = 99999;
  io::SindaStyle sinda_;
  double min_coupling_ = 0;
};

}  // namespace apps
