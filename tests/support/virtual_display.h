#pragma once

#include <string>

#include <sys/types.h>

namespace radiosity::test {

/// An X server without a screen (Xvfb) while it lives; programs that are started meanwhile use it.
class VirtualDisplay {
 public:
  /// Starts it on a free display number.
  VirtualDisplay();
  ~VirtualDisplay();
  VirtualDisplay(const VirtualDisplay&) = delete;
  VirtualDisplay& operator=(const VirtualDisplay&) = delete;

  /// Whether there is one; without Xvfb there is not.
  [[nodiscard]] bool is_there() const { return !name_.empty(); }

 private:
  pid_t pid_ = -1;
  std::string name_;
};

}  // namespace radiosity::test
