#pragma once

#include <string>

namespace CLI {
class App;
class ParseError;
}  // namespace CLI

namespace apps {

/// One line that says what is wrong with the command line, naming the option or command that was
/// probably meant, and where to read more. `program` has just failed to parse with `error`.
std::string usage_message(const CLI::App& program, const CLI::ParseError& error);

}  // namespace apps
