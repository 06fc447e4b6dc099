#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace io {

/// Cell data of a VTK file.
struct CellValues {
  std::string name;            ///< of the array that was found; empty if there is none
  std::vector<double> values;  ///< one for each cell
};

}  // namespace io

/// Reads of a .vtk, .vtp or .vtu file the first of the arrays of cells of these names that is there
/// and has one number for each cell. Throws SceneError naming `path`. Null in programs that do not
/// link io_vtk: those that do tell the linker by this name, which C++ leaves as it is, that they
/// want it.
extern "C" [[gnu::weak]] void radiosity_io_read_cell_values(const std::filesystem::path& path,
                                                            std::span<const std::string_view> names,
                                                            io::CellValues& result);
