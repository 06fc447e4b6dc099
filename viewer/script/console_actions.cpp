#include "viewer/script/console_actions.h"

#include <algorithm>
#include <stdexcept>

namespace viewer {
namespace {

bool set_lines(Stage& stage, ScriptArguments& arguments) {
  const long n_lines = arguments.integer("lines");
  if (n_lines < 1) throw std::invalid_argument("'lines' must be at least 1");
  set_console_lines(stage.desk, static_cast<int>(std::min(n_lines, 1000L)));
  return true;
}

}  // namespace

std::map<std::string, ActionKind> console_actions() {
  return {{"set-console", {"lines", set_lines}},
          {"set-scale",
           {"scale",
            [](Stage& stage, ScriptArguments& arguments) {
              set_scale(stage.desk, arguments.number("scale"));
              return true;
            }}},
          {"clear-messages",
           {"",
            [](Stage& stage, ScriptArguments&) {
              stage.desk.session.clear_messages();
              return true;
            }}},
          {"copy-messages", {"", [](Stage& stage, ScriptArguments&) {
                               stage.desk.copied = messages_text(stage.desk.session);
                               return true;
                             }}}};
}

}  // namespace viewer
