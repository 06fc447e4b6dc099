#pragma once

#include <gtest/gtest.h>

#include <string>

namespace radiosity::test {

/// Fails, and shows the text, where the part is not in it.
inline void expect_contains(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << "in: " << text;
}

}  // namespace radiosity::test
