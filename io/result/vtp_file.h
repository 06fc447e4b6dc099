#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

#include "io/result/vtp_values.h"

namespace io {

enum class VtkKind {
  polygons,     ///< PolyData, .vtp
  unstructured  ///< UnstructuredGrid, .vtu
};

/// What a file of cells holds, by the names of the arrays. Values at points are left out.
struct VtpFile {
  using Arrays = std::map<std::string, VtpArray>;
  VtkKind kind = VtkKind::polygons;
  std::uint64_t n_points = 0;
  std::uint64_t n_polygons = 0;         ///< of a .vtu: cells of any type
  std::uint64_t n_other_cells = 0;      ///< vertices, lines and strips; of a .vtu none
  std::uint64_t n_verts_and_lines = 0;  ///< of these, those whose values come before the polygons'
  VtpArray points;
  Arrays polygons;  ///< "connectivity" and "offsets", of a .vtu "types", too
  Arrays cells;     ///< a row for each cell
  Arrays fields;
};

/// Reads VTK XML of one piece: values as text, in base64, or appended raw or in base64; not
/// compressed, or by zlib or LZ4. VTK's own reader follows what a damaged file says into any part
/// of the memory; here all numbers are checked against each other and against what the file can
/// hold before anything is allocated. Throws SceneError naming `path`.
VtpFile read_vtp(const std::filesystem::path& path);
/// The same of either kind.
VtpFile read_vtk_xml(const std::filesystem::path& path);

}  // namespace io
