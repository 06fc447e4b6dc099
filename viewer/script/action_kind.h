#pragma once

#include <functional>
#include <string>

#include "viewer/desk/desk.h"
#include "viewer/script/script_arguments.h"
#include "viewer/script/script_host.h"

namespace viewer {

/// What an action works on, and whether it is done.
struct Stage {
  Desk& desk;
  ScriptHost& host;
  double seconds;  ///< since the action began
  bool is_first;   ///< whether this is its first frame
};

/// Returns whether the action is done; called again with the next frame if not.
using Perform = std::function<bool(Stage&, ScriptArguments&)>;

/// What an action is called with and does.
struct ActionKind {
  std::string main_key;  ///< of the argument in the short form {"action": argument}
  Perform perform;
};

/// An action that is done at once.
inline Perform at_once(std::function<void(Stage&, ScriptArguments&)> work) {
  return [work = std::move(work)](Stage& stage, ScriptArguments& arguments) {
    work(stage, arguments);
    return true;
  };
}

}  // namespace viewer
