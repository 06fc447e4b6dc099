// What the file browser lists.
#include <gtest/gtest.h>

#include <regex>
#include <string>

#include "io/scene/scene_file.h"
#include "radiosity/base/error.h"
#include "viewer/panels/file_browser.h"

namespace radiosity::test {
namespace {

// The reader itself tells what it reads.
TEST(FileBrowser, ListsAllThatCanBeRead) {
  std::string told;
  try {
    (void)io::read_scene("scene.unknown");
  } catch (const SceneError& error) {
    told = error.what();
  }
  const std::size_t list = told.find(".obj");
  ASSERT_NE(list, std::string::npos) << told;
  const std::string known = told.substr(list);
  const std::regex extension(R"(\.[A-Za-z0-9]+)");
  int n = 0;
  for (std::sregex_iterator it(known.begin(), known.end(), extension), end; it != end; ++it, ++n) {
    EXPECT_TRUE(viewer::is_listed("folder/a" + it->str())) << it->str();
  }
  EXPECT_GE(n, 14);
  for (const char* name : {"a.vtp", "F.h5", "ZONE.IDF", "zone.epJSON"}) {
    EXPECT_TRUE(viewer::is_listed(name)) << name;
  }
  for (const char* name : {"a.png", "lamp.ies", "notes.txt", "json"}) {
    EXPECT_FALSE(viewer::is_listed(name)) << name;
  }
}

}  // namespace
}  // namespace radiosity::test
