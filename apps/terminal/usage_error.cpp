#include "apps/terminal/usage_error.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/App.hpp>
#include <algorithm>
#include <optional>
#include <vector>

#include "io/base/json_item.h"

namespace apps {
namespace {

/// "; did you mean X?" if one of the names is close to `found`, else nothing.
std::string suggestion(const std::string& found, const std::vector<std::string>& names) {
  const auto nearest =
      std::min_element(names.begin(), names.end(), [&](const std::string& a, const std::string& b) {
        return io::edit_distance(found, a) < io::edit_distance(found, b);
      });
  if (nearest == names.end() || io::edit_distance(found, *nearest) > (found.size() + 1) / 3)
    return "";
  return fmt::format("; did you mean '{}'?", *nearest);
}

std::vector<std::string> option_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

std::vector<std::string> command_names(const CLI::App& program) {
  std::vector<std::string> names;
  for (const CLI::App* command : program.get_subcommands({})) names.push_back(command->get_name());
  return names;
}

/// What was not understood, if that is the trouble. `command` is the program itself if no
/// subcommand was recognised.
std::optional<std::string> unknown_argument(const CLI::App& program, const CLI::App& command) {
  const std::vector<std::string> extras = program.remaining(true);
  if (extras.empty()) return std::nullopt;
  const std::string& extra = extras.front();
  const bool is_option = extra.size() > 1 && extra.front() == '-';
  const std::string name = extra.substr(0, extra.find('='));
  const bool stands_first = !program.remaining(false).empty();
  if (is_option && stands_first && &command != &program) {
    return fmt::format("option '{}' must follow the command", name);
  }
  if (is_option) {
    return fmt::format("unknown option '{}'{}", name, suggestion(name, option_names(command)));
  }
  if (&command == &program) {
    return fmt::format("unknown command '{}'{}", extra, suggestion(extra, command_names(program)));
  }
  return fmt::format("unexpected argument '{}'", extra);
}

}  // namespace

std::string usage_message(const CLI::App& program, const CLI::ParseError& error) {
  const auto chosen = program.get_subcommands();
  const CLI::App& command = chosen.empty() ? program : *chosen.front();
  std::string what = error.what();
  if (const auto unknown = unknown_argument(program, command)) {
    what = *unknown;
  } else if (chosen.empty()) {
    what = fmt::format("no command: expected {}", fmt::join(command_names(program), ", "));
  }
  const std::string help = chosen.empty() ? "radiosity" : "radiosity " + command.get_name();
  return fmt::format("{} (see {} --help)", what, help);
}

}  // namespace apps
