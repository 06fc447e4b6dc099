#include "apps/run/factor_format.h"

#include <filesystem>

#include "apps/terminal/output_files.h"
#include "io/base/extension.h"

namespace apps {

bool is_foam_file(const std::string& path) { return std::filesystem::path(path).filename() == "F"; }

const std::vector<std::string>& factor_format_names() {
  static const std::vector<std::string> names = {"elmer", "elmer-binary", "moose", "openfoam",
                                                 "energyplus"};
  return names;
}

std::string check_factor_output(const std::string& path) {
  if (is_foam_file(path)) return "";
  const std::string refusal = check_extension(path, form_factor_extensions());
  return refusal.empty() ? refusal
                         : refusal + ", or F, in the folder constant of a case of OpenFOAM";
}

FactorFormat factor_format(const std::string& path, const std::string& asked) {
  if (is_foam_file(path)) return FactorFormat::openfoam;
  const std::string extension = io::lower_case_extension(path);
  if (extension == ".h5") return FactorFormat::hdf5;
  if (extension == ".idf" || extension == ".epjson") return FactorFormat::energyplus;
  if (extension == ".dat") {
    return asked == "elmer-binary" ? FactorFormat::elmer_binary : FactorFormat::elmer;
  }
  return extension == ".csv" && asked == "moose" ? FactorFormat::moose : FactorFormat::table;
}

bool is_by_polygon(FactorFormat format) {
  return format == FactorFormat::elmer || format == FactorFormat::elmer_binary ||
         format == FactorFormat::openfoam;
}

bool is_table(FactorFormat format) {
  return format != FactorFormat::hdf5 && !is_by_polygon(format);
}

}  // namespace apps
