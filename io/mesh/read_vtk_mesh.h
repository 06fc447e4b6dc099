#pragma once

#include <filesystem>

#include "io/mesh/file_scene.h"

/// Reads the polygons of a .vtk, .vtp or .vtu file. Null in programs that do not link io_vtk: those
/// that do tell the linker by this name, which C++ leaves as it is, that they want it.
extern "C" [[gnu::weak]] void radiosity_io_read_vtk_mesh(const std::filesystem::path& path,
                                                         io::FileScene& result);
