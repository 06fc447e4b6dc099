#include "viewer/script/comparison_actions.h"

#include <stdexcept>

#include "viewer/desk/pinning.h"

namespace viewer {
namespace {

bool compare_light(Stage& stage, ScriptArguments& arguments) {
  Desk& desk = stage.desk;
  const std::string mode = arguments.text("mode");
  const auto comparison = comparison_named(mode);
  if (!comparison) {
    throw std::invalid_argument("no comparison is called '" + mode +
                                "'; there are none, wipe, difference");
  }
  const double split = arguments.number_or("split", desk.pinning.split);
  if (!(split >= 0 && split <= 1)) throw std::invalid_argument("'split' must be in [0, 1]");
  compare(desk, *comparison);
  set_split(desk, split);
  return true;
}

}  // namespace

std::map<std::string, ActionKind> comparison_actions() {
  return {{"pin",
           {"",
            [](Stage& stage, ScriptArguments&) {
              pin(stage.desk);
              return true;
            }}},
          {"unpin",
           {"",
            [](Stage& stage, ScriptArguments&) {
              unpin(stage.desk);
              return true;
            }}},
          {"compare", {"mode", compare_light}}};
}

}  // namespace viewer
