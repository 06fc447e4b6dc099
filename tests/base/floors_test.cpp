#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

/// From bottom to top, as docs/DESIGN.md has them: each folder uses itself and those before it.
const std::vector<std::string> kFloors = {"radiosity/base",
                                          "radiosity/polygon",
                                          "radiosity/scene",
                                          "radiosity/operator",
                                          "radiosity/solve",
                                          "radiosity/visibility",
                                          "radiosity/exchange",
                                          "radiosity/assembly",
                                          "radiosity/compressed",
                                          "radiosity/stream",
                                          "radiosity/picture",
                                          "radiosity/meter",
                                          "radiosity",
                                          "meshing/base",
                                          "meshing/patches",
                                          "meshing/inspect",
                                          "meshing/adaptive",
                                          "study",
                                          "io/base",
                                          "io/picture",
                                          "io/mesh",
                                          "io/light",
                                          "io/scene",
                                          "io/result",
                                          "python/bindings",
                                          "viewer/work",
                                          "viewer/desk",
                                          "viewer/draw",
                                          "viewer/panels",
                                          "viewer/script",
                                          "viewer",
                                          "apps/validation/plot",
                                          "apps/validation/reference",
                                          "apps/validation/cases",
                                          "apps/validation/report",
                                          "apps/cluster",
                                          "apps/terminal",
                                          "apps/options",
                                          "apps/run",
                                          "apps/summary",
                                          "apps/report",
                                          "apps/commands"};

struct Source {
  std::string folder;
  std::vector<std::string> includes;  ///< of our own headers
  int n_lines = 0;
};

/// By path from the top of the project.
std::map<std::string, Source> read_sources() {
  std::map<std::string, Source> result;
  const fs::path top(RADIOSITY_SOURCES);
  const std::regex include("#include \"([^\"]+)\".*");
  for (const char* folder : {"radiosity", "meshing", "study", "io", "python", "viewer", "apps"}) {
    for (const auto& entry : fs::recursive_directory_iterator(top / folder)) {
      const fs::path& path = entry.path();
      if (path.extension() != ".h" && path.extension() != ".cpp") continue;
      Source source;
      source.folder = fs::relative(path.parent_path(), top).generic_string();
      std::ifstream stream(path);
      std::smatch match;
      for (std::string line; std::getline(stream, line); ++source.n_lines) {
        if (!std::regex_match(line, match, include)) continue;
        if (match[1] == "radiosity/version.h")
          continue;  // CMake makes it; it includes none of ours
        source.includes.push_back(match[1]);
      }
      result[fs::relative(path, top).generic_string()] = source;
    }
  }
  return result;
}

std::ptrdiff_t floor_of(const std::string& folder) {
  return std::find(kFloors.begin(), kFloors.end(), folder) - kFloors.begin();
}

std::string without_extension(const std::string& path) { return path.substr(0, path.rfind('.')); }

TEST(Floors, FoldersUseOnlyThoseBelow) {
  const std::map<std::string, Source> sources = read_sources();
  EXPECT_GT(sources.size(), 400U);
  for (const auto& [path, source] : sources) {
    ASSERT_LT(floor_of(source.folder), std::ssize(kFloors)) << path << " is on no floor";
    for (const std::string& header : source.includes) {
      ASSERT_TRUE(sources.count(header)) << path << " includes " << header;
      EXPECT_LE(floor_of(sources.at(header).folder), floor_of(source.folder))
          << path << " includes " << header;
    }
  }
}

/// Whether a header and its source, taken as one, lead back to themselves.
bool is_in_circle(const std::map<std::string, std::set<std::string>>& uses,
                  const std::string& start) {
  std::set<std::string> seen;
  std::vector<std::string> next{start};
  while (!next.empty()) {
    const std::string part = next.back();
    next.pop_back();
    for (const std::string& used : uses.at(part)) {
      if (used == start) return true;
      if (seen.insert(used).second) next.push_back(used);
    }
  }
  return false;
}

TEST(Floors, NoPartUsesItselfByWayOfOthers) {
  std::map<std::string, std::set<std::string>> uses;
  for (const auto& [path, source] : read_sources()) {
    const std::string part = without_extension(path);
    uses[part];
    for (const std::string& header : source.includes) {
      if (without_extension(header) != part) uses[part].insert(without_extension(header));
    }
  }
  for (const auto& [part, used] : uses) EXPECT_FALSE(is_in_circle(uses, part)) << part;
}

}  // namespace
