#include <fmt/format.h>

#include "io/base/extension.h"
#include "io/base/line_reader.h"
#include "io/result/read_cell_values.h"
#include "io/result/vtk_legacy_file.h"
#include "io/result/vtp_file.h"
#include "io/result/vtp_values.h"

void radiosity_io_read_cell_values(const std::filesystem::path& path,
                                   std::span<const std::string_view> names,
                                   io::CellValues& result) {
  using namespace io;
  const VtpFile file =
      lower_case_extension(path) == ".vtk" ? read_vtk_legacy(path) : read_vtk_xml(path);
  for (const std::string_view name : names) {
    const auto found = file.cells.find(std::string(name));
    if (found == file.cells.end()) continue;
    const VtpArray& array = found->second;
    if (array.type == "String" || array.n_components != 1) {
      fail(path, fmt::format("cell data \"{}\" is not one number for each cell", name));
    }
    if (file.n_other_cells > 0) {
      fail(path, "has vertices, lines or strips; expected polygons only");
    }
    result.name = name;
    for (std::size_t k = 0; k < n_values(array); ++k) {
      result.values.push_back(number<double>(array, k));
    }
    return;
  }
}
