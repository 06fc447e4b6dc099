#include "viewer/script/help_actions.h"

#include <stdexcept>

#include "viewer/desk/tour.h"

namespace viewer {
namespace {

/// A step from 1, or none.
bool set_tour(Stage& stage, ScriptArguments& arguments) {
  if (arguments.value("step").is_null()) {
    end_tour(stage.desk);
  } else {
    show_tour(stage.desk, static_cast<int>(arguments.integer("step") - 1));
  }
  return true;
}

bool open_example(Stage& stage, ScriptArguments& arguments) {
  const std::string name = arguments.text("name");
  const Example* example = stage.desk.examples.named(name);
  if (example == nullptr) throw std::invalid_argument("no example is called '" + name + "'");
  stage.host.open(example->path);
  return true;
}

}  // namespace

std::map<std::string, ActionKind> help_actions() {
  return {{"reload",
           {"",
            [](Stage& stage, ScriptArguments&) {
              reload(stage.desk);
              return true;
            }}},
          {"tour", {"step", set_tour}},
          {"open-example", {"name", open_example}}};
}

}  // namespace viewer
