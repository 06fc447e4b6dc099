#pragma once

#include <chrono>
#include <functional>
#include <thread>

namespace radiosity::test {

/// Waits until the condition holds; whether it does within a minute, which is enough for whatever
/// happens at once, however crowded the machine is.
inline bool wait_until(const std::function<bool()>& condition) {
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::minutes(1);
  while (!condition()) {
    if (std::chrono::steady_clock::now() > deadline) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return true;
}

}  // namespace radiosity::test
