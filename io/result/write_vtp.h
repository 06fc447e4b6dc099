#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "radiosity/scene/patch_mesh.h"
#include "radiosity/scene/scene.h"
#include "radiosity/solve/quantity.h"
#include "radiosity/solve/solution.h"

/// Writes a .vtp as `io::write` does with these of its options. Null in programs that do not link
/// io_vtk: those that do tell the linker by this name, which C++ leaves as it is, that they want
/// it.
extern "C" [[gnu::weak]] void radiosity_io_write_vtp(
    const std::filesystem::path& path, const radiosity::PatchMesh& mesh,
    const radiosity::Solution& solution, const std::vector<radiosity::QuantityField>& quantities,
    const std::optional<radiosity::Bands>& bands, const std::optional<radiosity::Camera>& camera);
