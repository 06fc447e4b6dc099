#pragma once

#include <vtkSmartPointer.h>

#include <filesystem>

class vtkPolyData;

namespace io {

/// Reads VTK XML (.vtp). Nothing is printed: while it reads, VTK's messages, of all threads, are
/// kept from the terminal. Throws SceneError naming `path` if there is no such file, if it is
/// something else, ends too early, or does not hold what it says.
vtkSmartPointer<vtkPolyData> read_polydata(const std::filesystem::path& path);

}  // namespace io
