#pragma once

#include <optional>
#include <string>

#include "apps/options/common_options.h"
#include "apps/terminal/interruption.h"

namespace CLI {
class App;
}  // namespace CLI

namespace apps {

/// `radiosity view`: the desktop window. Must outlive the parsing.
class ViewCommand {
 public:
  ViewCommand(CLI::App& program, Interruption& interruption);

 private:
  void run() const;

  Interruption& interruption_;
  std::optional<std::string> path_;
  std::optional<std::string> unit_;
  std::optional<double> precision_;
  bool strict_ = false;
  std::optional<std::string> script_;
  std::optional<std::string> screenshot_;
  std::size_t n_threads_ = 0;
  int width_ = 0;   // 0 = what suits
  int height_ = 0;  // likewise
  std::string up_;
  double scale_ = 0;
  study::StudyOptions compute_;
};

}  // namespace apps
