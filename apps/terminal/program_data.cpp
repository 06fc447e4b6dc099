#include "apps/terminal/program_data.h"

#include <filesystem>
#include <system_error>

namespace apps {

namespace fs = std::filesystem;

std::string program_data(const std::string& of_source, const std::string& name) {
  std::error_code error;
  if (fs::is_directory(of_source, error)) return of_source;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  return (program.parent_path().parent_path() / "share/radiosity" / name).string();
}

}  // namespace apps
