#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <string>
#include <thread>

#include "viewer/work/session.h"

namespace radiosity::test {

using namespace std::chrono_literals;

inline const std::string kRoom = std::string(RADIOSITY_SCENES) + "/l-room.json";
inline const std::string kBox = std::string(RADIOSITY_SCENES) + "/cornell-box.json";
inline const std::string kThermal = std::string(RADIOSITY_SCENES) + "/thermal-enclosure.json";

/// With what takes seconds, but for a machine under load and sanitizers.
inline constexpr auto kPatience = 900s;

/// Coarse enough for a test to take seconds.
inline study::StudyOptions coarse() { return {.patches = {.n_patches = 300}}; }

inline void wait_until(viewer::Session& session, const std::function<bool()>& is_done) {
  const auto deadline = std::chrono::steady_clock::now() + kPatience;
  while (!is_done()) {
    ASSERT_LT(std::chrono::steady_clock::now(), deadline);
    session.update();
    std::this_thread::sleep_for(1ms);
  }
}

inline void settle(viewer::Session& session) {
  wait_until(session, [&] { return session.is_idle(); });
}

inline void open(viewer::Session& session, const std::string& path) {
  session.open(path);
  settle(session);
}

}  // namespace radiosity::test
