#pragma once

#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "viewer/desk/desk.h"
#include "viewer/script/script_host.h"

namespace viewer {

/// A script that cannot be read, or an action of it that cannot be done. The message names file and
/// action.
struct ScriptError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A list of actions, docs/viewer.md, done one after the other as a person would do them.
class Script {
 public:
  /// Reads .json. Throws ScriptError.
  explicit Script(const std::filesystem::path& path);
  ~Script();
  Script(Script&&) noexcept;
  Script& operator=(Script&&) noexcept;

  /// Does the next action unless the last one still waits for something; once a frame. Throws
  /// ScriptError.
  void advance(Desk& desk, ScriptHost& host);
  [[nodiscard]] bool has_ended() const;
  /// The files that its actions write.
  [[nodiscard]] std::vector<std::string> outputs() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace viewer
