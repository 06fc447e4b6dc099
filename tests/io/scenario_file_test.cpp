// Lists of scenarios, and what is wrong with some.
#include "io/scene/scenario_file.h"

#include <gtest/gtest.h>

#include <string>

#include "tests/support/scratch_files.h"

namespace {

using radiosity::Scenario;

class ScenarioFile : public ScratchFiles {
 protected:
  [[nodiscard]] std::string refusal(const std::string& text) const {
    try {
      (void)io::read_scenarios(file("s.json", text));
      return "";
    } catch (const radiosity::SceneError& error) {
      return error.what();
    }
  }
  /// The same of one scenario with this in it.
  [[nodiscard]] std::string refusal_of(const std::string& part) const {
    return refusal(R"({"scenarios": [{"name": "a", )" + part + "}]}");
  }
};

TEST_F(ScenarioFile, IsReadInItsOrder) {
  const auto scenarios = io::read_scenarios(file("s.json", R"({
    "description": "two", "scenarios": [
      {"name": "day", "lights": {"*": "off", "window*": "on", "lamp ?": 0.4}},
      {"name": "night ü", "description": "dark", "reflectances": {"wall": 0.6, "floor": [0.3, 0, 1]}}
    ]})"));
  ASSERT_EQ(scenarios.size(), 2U);
  EXPECT_EQ(scenarios[0].name, "day");
  ASSERT_EQ(scenarios[0].lights.size(), 3U);
  EXPECT_EQ(scenarios[0].lights[0].surfaces, "*");
  EXPECT_EQ(scenarios[0].lights[0].factor, 0);
  EXPECT_EQ(scenarios[0].lights[1].factor, 1);
  EXPECT_EQ(scenarios[0].lights[2].surfaces, "lamp ?");
  EXPECT_EQ(scenarios[0].lights[2].factor, 0.4);
  EXPECT_TRUE(scenarios[0].paints.empty());
  ASSERT_EQ(scenarios[1].paints.size(), 2U);
  EXPECT_EQ(scenarios[1].paints[0].reflectance, Eigen::VectorXd::Constant(1, 0.6));
  EXPECT_EQ(scenarios[1].paints[1].reflectance, Eigen::Vector3d(0.3, 0, 1));
}

TEST_F(ScenarioFile, ExplainsWhatIsWrong) {
  EXPECT_CONTAINS(refusal("{"), "s.json:1");
  EXPECT_CONTAINS(refusal("{}"), "scenarios");
  EXPECT_CONTAINS(refusal(R"({"scenarios": []})"), "no scenario");
  EXPECT_CONTAINS(refusal(R"({"scenarios": [{}]})"), "name");
  EXPECT_CONTAINS(refusal(R"({"scenarios": [{"name": "a"}, {"name": "a"}]})"), "scenarios[1].name");
  EXPECT_CONTAINS(refusal(R"({"scenarios": [{"name": "a/b"}]})"), "'/'");
  EXPECT_CONTAINS(refusal_of(R"("light": {})"), "lights");
  EXPECT_CONTAINS(refusal_of(R"("lights": [])"), "expected an object");
  EXPECT_CONTAINS(refusal_of(R"("lights": {"x": "dim"})"), "'dim'");
  EXPECT_CONTAINS(refusal_of(R"("lights": {"x": -1})"), "at least 0");
  EXPECT_CONTAINS(refusal_of(R"("reflectances": {"x": 1.5})"), "from 0 to 1");
  EXPECT_CONTAINS(refusal_of(R"("reflectances": {"x": []})"), "no value");
  EXPECT_CONTAINS(refusal_of(R"("reflectances": {"x": "white"})"), "s.json: scenarios[0]");
}

}  // namespace
