#pragma once

#include <gtest/gtest.h>

#include <array>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "tests/support/program.h"
#include "tests/support/virtual_display.h"

namespace radiosity::test {

inline const std::string kBox = std::string(RADIOSITY_SCENES) + "/cornell-box.json";

/// 8-bit RGB, row by row from the top.
struct Picture {
  int width = 0;
  int height = 0;
  std::vector<unsigned char> bytes;

  [[nodiscard]] std::array<int, 3> at(int x, int y) const;
};

Picture read_png(const fs::path& path);

/// Sets a variable of the programs that are started, while it lives.
class Environment {
 public:
  Environment(std::string name, const char* value);
  ~Environment();
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;

 private:
  void set(const char* value);

  std::string name_;
  std::optional<std::string> before_;
};

/// `radiosity view` on a virtual display.
class ViewProgram : public Program {
 protected:
  ViewProgram();
  void SetUp() override;

  /// Runs the script with 600 patches in a window of 640 x 400 pixels, as OpenGL is software here;
  /// its reports and pictures are in results.
  Outcome run_script(const nlohmann::json& actions, const Arguments& more = {}) const;
  /// The same, while the test goes on.
  Running start_script(const nlohmann::json& actions) const;
  nlohmann::json report(const std::string& name) const;

 private:
  VirtualDisplay display_;
  Environment state_;
};

/// The same under real keys and clicks, which xdotool makes.
class ViewProgramByHand : public ViewProgram {
 protected:
  void SetUp() override;

  /// What xdotool is to do. Keys are 5 ms apart where they follow each other: two presses of one
  /// within a millisecond are one to GLFW.
  static void act(const std::string& what);
};

/// The colour in the picture's part of a window, x and y in [0, 1].
std::array<int, 3> color_at(const Picture& picture, const nlohmann::json& report, double x,
                            double y);

}  // namespace radiosity::test
