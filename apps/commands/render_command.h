#pragma once

#include <optional>
#include <string>

#include "apps/options/common_options.h"
#include "apps/terminal/interruption.h"
#include "study/study_options.h"

namespace CLI {
class App;
}  // namespace CLI

namespace apps {

/// `radiosity render SCENE -o PICTURE`: computes the radiosity and writes a picture of the scene.
/// Adds itself to the program and runs when that is parsed; must outlive the parsing.
class RenderCommand {
 public:
  RenderCommand(CLI::App& program, Interruption& interruption);
  RenderCommand(const RenderCommand&) = delete;
  RenderCommand& operator=(const RenderCommand&) = delete;

 private:
  void run() const;

  Interruption& interruption_;
  CommonOptions common_;
  study::StudyOptions compute_;
  std::optional<std::string> operator_;
  PictureOptions picture_;
  std::string output_;
};

}  // namespace apps
