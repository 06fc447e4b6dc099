#include "viewer/script/script.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>

#include "viewer/script/script_actions.h"

namespace viewer {
namespace {

using nlohmann::json;
using Clock = std::chrono::steady_clock;

struct Action {
  std::string name;
  json arguments;
};

std::string known_name(std::string name) {
  std::replace(name.begin(), name.end(), '_', '-');
  std::replace(name.begin(), name.end(), ' ', '-');
  static const std::map<std::string, std::string> others = {{"open", "load"},
                                                            {"select", "select-patch"},
                                                            {"show", "set-quantity"},
                                                            {"wait-for-solved", "wait-solved"}};
  if (const auto other = others.find(name); other != others.end()) name = other->second;
  if (!action_kinds().contains(name)) {
    std::string list;
    for (const auto& [known, kind] : action_kinds()) {
      list += (list.empty() ? "" : ", ") + known;
    }
    throw std::invalid_argument(fmt::format("no action is called '{}'; there are {}", name, list));
  }
  return name;
}

/// {"action": "load", "scene": "x"}, {"load": "x"}, {"load": {"scene": "x"}} or "fit".
Action as_action(const json& item) {
  if (item.is_string()) return {known_name(item.get<std::string>()), json::object()};
  if (!item.is_object() || item.empty()) {
    throw std::invalid_argument("found " + item.dump() + R"(, expected {"action": "name", ...})");
  }
  if (item.contains("action")) {
    if (!item["action"].is_string()) throw std::invalid_argument("'action' must be a text");
    return {known_name(item["action"].get<std::string>()), item};
  }
  const auto first = item.begin();
  if (item.size() != 1) {
    throw std::invalid_argument("found " + item.dump() + R"(, expected {"action": "name", ...})");
  }
  const std::string name = known_name(first.key());
  if (first.value().is_object()) return {name, first.value()};
  const std::string& key = action_kinds().at(name).main_key;
  if (key.empty()) throw std::invalid_argument("'" + name + "' needs its arguments by name");
  return {name, {{key, first.value()}}};
}

json parsed(const std::filesystem::path& path) {
  std::ifstream stream(path);
  if (!stream) throw ScriptError(path.string() + ": cannot be read");
  try {
    json list = json::parse(stream);
    if (list.is_object() && list.contains("actions")) list = list["actions"];
    if (!list.is_array()) throw ScriptError(path.string() + ": expected a list of actions");
    return list;
  } catch (const json::exception& error) {
    throw ScriptError(path.string() + ": " + error.what());
  }
}

}  // namespace

struct Script::State {
  std::string path;
  std::vector<Action> actions;
  std::size_t next = 0;
  std::optional<Clock::time_point> begun;  // of the action that is being done

  [[nodiscard]] std::string place(std::size_t k) const {
    return fmt::format("{}: action {}", path, k);
  }
};

Script::Script(const std::filesystem::path& path) : state_(std::make_unique<State>()) {
  state_->path = path.string();
  const json list = parsed(path);
  for (std::size_t k = 0; k < list.size(); ++k) {
    try {
      state_->actions.push_back(as_action(list[k]));
    } catch (const std::exception& error) {
      throw ScriptError(state_->place(k) + ": " + error.what());
    }
  }
}

Script::~Script() = default;
Script::Script(Script&&) noexcept = default;
Script& Script::operator=(Script&&) noexcept = default;

std::vector<std::string> Script::outputs() const {
  std::vector<std::string> files;
  for (const Action& action : state_->actions) {
    const bool is_writing = action.name == "report" || action.name == "screenshot" ||
                            action.name == "save-result" || action.name == "save-scene" ||
                            action.name == "save-readings";
    if (!is_writing || !action.arguments.contains("file")) continue;
    if (action.arguments["file"].is_string()) files.push_back(action.arguments["file"]);
  }
  return files;
}

bool Script::has_ended() const { return state_->next >= state_->actions.size(); }

void Script::advance(Desk& desk, ScriptHost& host) {
  if (has_ended()) return;
  State& state = *state_;
  const Action& action = state.actions[state.next];
  const auto now = Clock::now();
  const bool is_first = !state.begun;
  if (is_first) state.begun = now;
  Stage stage{desk, host, std::chrono::duration<double>(now - *state.begun).count(), is_first};
  try {
    ScriptArguments arguments(action.arguments);
    const bool is_done = action_kinds().at(action.name).perform(stage, arguments);
    arguments.check_all_used();
    if (!is_done) return;
  } catch (const std::exception& error) {
    throw ScriptError(
        fmt::format("{} ({}): {}", state.place(state.next), action.name, error.what()));
  }
  ++state.next;
  state.begun.reset();
}

}  // namespace viewer
