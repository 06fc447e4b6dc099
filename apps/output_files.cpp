#include "apps/output_files.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>

#include "io/extension.h"
#include "radiosity/error.h"

namespace apps {
namespace {

namespace fs = std::filesystem;

bool contains(const std::vector<std::string>& list, const std::string& item) {
  return std::find(list.begin(), list.end(), item) != list.end();
}

void check_output(const fs::path& output, const fs::path& scene) {
  const fs::path folder = output.has_parent_path() ? output.parent_path() : fs::path(".");
  std::error_code ignored;
  const auto refuse = [&](const std::string& reason) {
    throw radiosity::OutputError(fmt::format("{}: cannot be written: {}", output.string(), reason));
  };
  if (!fs::exists(folder, ignored)) {
    refuse(fmt::format("there is no folder {}", folder.string()));
  } else if (!fs::is_directory(folder, ignored)) {
    refuse(fmt::format("{} is not a folder", folder.string()));
  } else if (::access(folder.c_str(), W_OK) != 0) {
    refuse(fmt::format("folder {}: {}", folder.string(),
                       std::error_code(errno, std::generic_category()).message()));
  } else if (fs::is_directory(output, ignored)) {
    refuse("it is a folder");
  } else if (fs::equivalent(output, scene, ignored)) {
    refuse("it is the scene file itself");
  }
}

}  // namespace

const std::vector<std::string>& result_extensions() {
  static const std::vector<std::string> extensions = {".vtp", ".csv", ".ply", ".png", ".exr"};
  return extensions;
}

const std::vector<std::string>& picture_extensions() {
  static const std::vector<std::string> extensions = {".png", ".exr"};
  return extensions;
}

const std::vector<std::string>& form_factor_extensions() {
  static const std::vector<std::string> extensions = {".h5", ".csv"};
  return extensions;
}

bool is_picture(const fs::path& path) {
  return contains(picture_extensions(), io::lower_case_extension(path));
}

std::string check_extension(const std::string& path, const std::vector<std::string>& allowed) {
  if (contains(allowed, io::lower_case_extension(path))) return "";
  return fmt::format("found '{}', expected a file name ending in one of {}", path,
                     fmt::join(allowed, " "));
}

void check_outputs(const std::vector<std::string>& outputs, const fs::path& scene) {
  for (const std::string& output : outputs) check_output(output, scene);
}

}  // namespace apps
