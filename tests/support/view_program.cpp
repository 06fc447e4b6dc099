#include "tests/support/view_program.h"

#include <png.h>

#include <cstdlib>
#include <utility>

namespace radiosity::test {

using nlohmann::json;

std::array<int, 3> Picture::at(int x, int y) const {
  const std::size_t first = 3 * (static_cast<std::size_t>(y) * width + x);
  return {bytes[first], bytes[first + 1], bytes[first + 2]};
}

Picture read_png(const fs::path& path) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  Picture picture;
  EXPECT_NE(png_image_begin_read_from_file(&image, path.c_str()), 0) << path;
  image.format = PNG_FORMAT_RGB;
  picture.width = static_cast<int>(image.width);
  picture.height = static_cast<int>(image.height);
  picture.bytes.resize(PNG_IMAGE_SIZE(image));
  png_image_finish_read(&image, nullptr, picture.bytes.data(), 0, nullptr);
  return picture;
}

Environment::Environment(std::string name, const char* value) : name_(std::move(name)) {
  if (const char* before = std::getenv(name_.c_str())) before_ = before;
  set(value);
}

Environment::~Environment() { set(before_ ? before_->c_str() : nullptr); }

void Environment::set(const char* value) {
  if (value != nullptr) {
    setenv(name_.c_str(), value, 1);
  } else {
    unsetenv(name_.c_str());
  }
}

// The list of recent files must not be the user's.
ViewProgram::ViewProgram() : state_("XDG_STATE_HOME", folder().c_str()) {}

void ViewProgram::SetUp() {
  if (!display_.is_there()) GTEST_SKIP() << "there is no Xvfb";
}

Running ViewProgram::start_script(const json& actions) const {
  return start({"view", "--patches", "60", "--script", write_file("script.json", actions.dump())});
}

Outcome ViewProgram::run_script(const json& actions, const Arguments& more) const {
  Arguments arguments = {"view",
                         "--patches",
                         "600",
                         "--width",
                         "640",
                         "--height",
                         "400",
                         "--ui-scale",
                         "0.5",
                         "--script",
                         write_file("script.json", actions.dump())};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return run(arguments);
}

json ViewProgram::report(const std::string& name) const {
  return json::parse(contents(result(name)));
}

void ViewProgramByHand::SetUp() {
  ViewProgram::SetUp();
  if (std::system("command -v xdotool > /dev/null") != 0) GTEST_SKIP() << "there is no xdotool";
}

void ViewProgramByHand::act(const std::string& what) {
  EXPECT_EQ(std::system(("xdotool " + what).c_str()), 0) << what;
}

/// The colour in the picture's part of a window, x and y in [0, 1].
std::array<int, 3> color_at(const Picture& picture, const json& report, double x, double y) {
  const json& region = report["region"];
  return picture.at(static_cast<int>(region["left"].get<int>() + x * region["width"].get<int>()),
                    static_cast<int>(region["top"].get<int>() + y * region["height"].get<int>()));
}

}  // namespace radiosity::test
