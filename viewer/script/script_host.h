#pragma once

#include <string>
#include <vector>

namespace viewer {

/// What only the window can do for a script.
class ScriptHost {
 public:
  virtual ~ScriptHost() = default;
  virtual void open(const std::string& path) = 0;
  virtual void resize(int width, int height) = 0;
  /// Milliseconds that the latest frames took, oldest first.
  [[nodiscard]] virtual std::vector<double> frame_times() const = 0;
  virtual void forget_frame_times() = 0;
};

}  // namespace viewer
