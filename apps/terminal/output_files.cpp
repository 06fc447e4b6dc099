#include "apps/terminal/output_files.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "io/base/extension.h"
#include "io/base/output_check.h"
#include "radiosity/base/error.h"

namespace apps {
namespace {

namespace fs = std::filesystem;

bool contains(const std::vector<std::string>& list, const std::string& item) {
  return std::find(list.begin(), list.end(), item) != list.end();
}

}  // namespace

const std::vector<std::string>& result_extensions() {
  static const std::vector<std::string> extensions = {".vtp", ".csv", ".ply", ".glb",
                                                      ".png", ".exr", ".h5"};
  return extensions;
}

const std::vector<std::string>& picture_extensions() {
  static const std::vector<std::string> extensions = {".png", ".exr"};
  return extensions;
}

const std::vector<std::string>& form_factor_extensions() {
  static const std::vector<std::string> extensions = {".h5",  ".csv", ".txt",
                                                      ".dat", ".idf", ".epjson"};
  return extensions;
}

bool is_picture(const fs::path& path) {
  return contains(picture_extensions(), io::lower_case_extension(path));
}

bool is_factor_file(const fs::path& path) { return io::lower_case_extension(path) == ".h5"; }

bool is_glb(const fs::path& path) { return io::lower_case_extension(path) == ".glb"; }

std::string check_extension(const std::string& path, const std::vector<std::string>& allowed) {
  if (contains(allowed, io::lower_case_extension(path))) return "";
  return fmt::format("found '{}', expected a file name ending in one of {}", path,
                     fmt::join(allowed, " "));
}

void check_outputs(const std::vector<std::string>& outputs, const fs::path& scene) {
  for (auto output = outputs.begin(); output != outputs.end(); ++output) {
    if (io::is_same_file(*output, scene)) {
      throw radiosity::OutputError(
          fmt::format("{}: cannot be written: it is the scene file itself", *output));
    }
    const auto same = std::find_if(outputs.begin(), output, [&](const std::string& other) {
      return io::is_same_file(*output, other);
    });
    if (same != output) {
      throw radiosity::OutputError(fmt::format(
          "{}: cannot be written: it is the same file as the output {}", *output, *same));
    }
    io::check_writable(*output);
  }
}

void check_against_inputs(const std::vector<std::string>& outputs,
                          const std::vector<fs::path>& inputs) {
  for (const std::string& output : outputs) io::check_not_input(output, inputs);
}

}  // namespace apps
